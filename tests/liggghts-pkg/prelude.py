# SPDX-License-Identifier: GPL-2.0-or-later
"""What every deck of the tests begins with: LIGGGHTS' settings, a box, materials, contact model, time step.

    Prelude("-0.01 0.01 -0.01 0.01 -0.01 0.01", E=(5e6, 1e7), nu=(0.3, 0.3), mu=0.4).text() + "create_atoms ..."
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Mapping, Sequence

INTEGRATION = "fix integrate all nve/sphere\n"
Pairs = float | Sequence[float]  # one number for all pairs of types, or one for each, row by row


@dataclass(frozen=True)
class Prelude:
    """Lengths, times and moduli are in `units`; there are as many atom types as Young's moduli."""

    box: str  # xlo xhi ylo yhi zlo zhi
    E: Sequence[float]  # Young's modulus of each type
    nu: Sequence[float]  # Poisson's ratio of each type
    e: Pairs = 1.0  # coefficient of restitution
    mu: Pairs = 0.0  # coefficient of friction
    further: Mapping[str, Pairs | str] = field(default_factory=dict)  # property/global: of pairs, or LIGGGHTS' own words
    models: str = "model hertz tangential history"  # of pairs of particles
    timestep: float | None = None  # None: the deck says it later
    skin: float = 2e-4
    lists: str = ""  # words of neigh_modify
    units: str = "si"
    boundary: str = "f f f"
    processors: str = ""
    particles: str = ""  # "hard" or "soft": moduli that LIGGGHTS takes for a mistake otherwise

    def text(self) -> str:
        """All that stands before the first particle."""
        return f"{self.settings}region box block {self.box} units box\ncreate_box {len(self.E)} box\n{self.contact}"

    def again(self, file: str) -> str:
        """The same, but box and particles are those of a restart file."""
        return f"{self.settings}read_restart {file}\n{self.contact}"

    @property
    def settings(self) -> str:
        lines = [f"units {self.units}", "atom_style granular", "atom_modify map array", f"boundary {self.boundary}"]
        lines += ["newton off", "communicate single vel yes"]
        lines += [f"processors {self.processors}"] * bool(self.processors)
        lines += [f"{self.particles}_particles yes"] * bool(self.particles)
        return "\n".join(lines) + "\n"

    @property
    def contact(self) -> str:
        lines = [f"neighbor {self.skin!r} bin"] + [f"neigh_modify {self.lists}"] * bool(self.lists)
        properties = {"youngsModulus": per_type(self.E), "poissonsRatio": per_type(self.nu)}
        properties |= {"coefficientRestitution": self.e, "coefficientFriction": self.mu, **self.further}
        for k, (name, value) in enumerate(properties.items(), start=1):
            lines.append(f"fix m{k} all property/global {name} {value if isinstance(value, str) else self.per_pair(value)}")
        lines += [f"pair_style gran {self.models}", "pair_coeff * *"]
        lines += [f"timestep {self.timestep!r}"] if self.timestep else []
        return "\n".join(lines) + "\n"

    def per_pair(self, value: Pairs) -> str:
        types = len(self.E)
        values = [value] * types**2 if isinstance(value, (int, float)) else value
        return f"peratomtypepair {types} " + " ".join(map(repr, values))


def per_type(values: Sequence[float]) -> str:
    return "peratomtype " + " ".join(map(repr, values))


def create(*centres: Sequence[float]) -> str:
    """Balls of type 1."""
    return "".join("create_atoms 1 single {!r} {!r} {!r} units box\n".format(*centre) for centre in centres)

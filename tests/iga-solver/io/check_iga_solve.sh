#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# iga-solve from outside: check_iga_solve.sh PROGRAM
set -eu
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat > fall.yaml <<'YAML'
units: si
geometry:
  box: {origin: [0, 0, 0], size: [1, 1, 1], elements: [2, 2, 2], degree: 2}
material: {law: linear_elastic, youngs_modulus: 1, poissons_ratio: 0.3, density: 2}
output: {every: 0.5, file: fall}
loads: {gravity: [0, 0, -3]}
time: {end: 2}
YAML

fail() { echo "FAILED: $1"; cat out err; exit 1; }

# A free body falls: kinetic energy = work of gravity = m (g t)^2 / 2 = 2 * 6^2 / 2, nothing is strained.
"$program" fall.yaml > out 2> err || fail "exit code of a good run"
grep -q 'elements     8 (2 x 2 x 2), degrees 2 2 2' out || fail "elements"
grep -q 'dof          192, 0 of them fixed' out || fail "dof"
grep -q 'mass         2$' out || fail "mass"
grep -Eq 'time 2: kinetic 36(\.0+)?, strain [0-9.]+e-[0-9]+, work of the loads 36(\.0+)?, ' out || fail "energies"
test -s fall.h5 || fail "histories"

# What is printed belongs together: value WORD... is the number after these words.
value() { sed -nE "s/.*$1 *([-+.e0-9]+).*/\\1/p" out; }
holds() { awk "BEGIN { exit !($1) }"; }
kinetic=$(value kinetic) strain=$(value strain) work=$(value 'work of the loads') balance=$(value balance)
holds "($balance) - ($kinetic + $strain - $work) < 1e-6 && ($balance) - ($kinetic + $strain - $work) > -1e-6" ||
  fail "balance"
# Steps of 0.9 of the stable one at most, and no fewer than needed: the last ends at the end.
stable=$(value 'stable step') step=$(value 'time step') steps=$(sed -nE 's/.*, ([0-9]+) steps$/\1/p' out)
expect_steps() {
  holds "$steps >= $2 / ($1) && $steps < $2 / ($1) + 1" || fail "$steps steps of at most $1"
  holds "$step * $steps > $2 * (1 - 1e-5) && $step * $steps < $2 * (1 + 1e-5)" || fail "$steps steps of $step"
}
expect_steps "0.9 * $stable" 2
"$program" fall.yaml --end 20 > out || fail "exit code with an end" # which more steps tell from other steps
step=$(value 'time step') steps=$(sed -nE 's/.*, ([0-9]+) steps$/\1/p' out)
expect_steps "0.9 * $stable" 20
sed "s/^time.*/time: {end: 2, step: 0.0625}/" fall.yaml > steps.yaml
"$program" steps.yaml > out || fail "exit code with a step"
step=$(value 'time step') steps=$(sed -nE 's/.*, ([0-9]+) steps$/\1/p' out)
holds "$steps == 32 && $step == 0.0625" || fail "the model file's step"
/usr/bin/python3 -c 'import h5py; print(*h5py.File("fall.h5")["time"][:])' > out
grep -qx '0.0 0.5 1.0 1.5 2.0' out || fail "times of the history"
"$program" fall.yaml --quiet > out 2> err || fail "exit code of a quiet run"
test ! -s out || fail "a quiet run prints"

# expect_error WORDS ARGUMENTS...: exit code 1, one line that starts with ERROR and has the words.
expect_error() {
  words=$1
  shift
  code=0
  timeout 60 "$program" "$@" > out 2> err || code=$?
  test "$code" -eq 1 || fail "exit code $code of: $*"
  test "$(wc -l < err)" -eq 1 || fail "lines of: $*"
  grep -q '^ERROR: ' err || fail "start of: $*"
  grep -Eq -- "$words" err || fail "words '$words' of: $*"
}
expect_error 'missing.yaml.*cannot read' missing.yaml
expect_error 'time step 5 is above the stable step [0-9.]+' fall.yaml --step 5
expect_error 'model' --end 1
expect_error '--end' fall.yaml --end -1
expect_error "'--stpe.*did you mean '--step'" fall.yaml --stpe 1
expect_error "--step: is 'fast', expected a number > 0" fall.yaml --step fast
sed '/^time/d' fall.yaml > endless.yaml
expect_error 'endless.yaml: no end time.*--end' endless.yaml
sed 's/density: 2/density: -2/' fall.yaml > negative.yaml
expect_error 'negative.yaml:4:.*density.*-2.*> 0' negative.yaml
sed 's/file: fall/file: none\/fall/' fall.yaml > nowhere.yaml
expect_error 'none/fall.h5' nowhere.yaml
expect_error "none/fall.h5: cannot write here: there is no folder 'none'" nowhere.yaml --check
sed 's/gravity: .*/tractions: [{face: zeta+, value: 3}]}/' fall.yaml > number.yaml
expect_error 'number.yaml:6: value is not a list, expected 3 numbers or expressions' number.yaml
sed 's/law: linear_elastic/law: Neo-Hooke/' fall.yaml > law.yaml
expect_error "law.yaml:4: law is 'Neo-Hooke', did you mean 'neo_hooke'" law.yaml
mkfifo pipe.yaml pipe.h5
expect_error 'pipe.yaml: cannot read.*named pipe' pipe.yaml
sed 's/file: fall/file: pipe/' fall.yaml > to_pipe.yaml
expect_error 'pipe.h5: cannot write here.*named pipe' to_pipe.yaml
printf 'ISO-10303-21;\nHEADER;\n' > plate.step
expect_error 'plate.step: is a STEP or IGES file, expected a model file' plate.step
printf '%s' '{"units": "si"},' > comma.json
expect_error 'comma.json:1: broken YAML' comma.json

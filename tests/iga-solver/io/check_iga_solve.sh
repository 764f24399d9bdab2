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
"$program" fall.yaml --quiet > out 2> err || fail "exit code of a quiet run"
test ! -s out || fail "a quiet run prints"

# expect_error WORDS ARGUMENTS...: exit code 1, one line that starts with ERROR and has the words.
expect_error() {
  words=$1
  shift
  code=0
  "$program" "$@" > out 2> err || code=$?
  test "$code" -eq 1 || fail "exit code $code of: $*"
  test "$(wc -l < err)" -eq 1 || fail "lines of: $*"
  grep -q '^ERROR: ' err || fail "start of: $*"
  grep -Eq -- "$words" err || fail "words '$words' of: $*"
}
expect_error 'missing.yaml.*cannot read' missing.yaml
expect_error 'time step 5 is above the stable step [0-9.]+' fall.yaml --step 5
expect_error 'model' --end 1
expect_error '--end' fall.yaml --end -1
expect_error '--stpe' fall.yaml --stpe 1
sed '/^time/d' fall.yaml > endless.yaml
expect_error 'endless.yaml: no end time.*--end' endless.yaml
sed 's/density: 2/density: -2/' fall.yaml > negative.yaml
expect_error 'negative.yaml:4:.*density.*-2.*> 0' negative.yaml
sed 's/file: fall/file: none\/fall/' fall.yaml > nowhere.yaml
expect_error 'none/fall.h5' nowhere.yaml

#!/bin/bash
# Tries the Snakefile here: two parts at a time, one of them killed; then the same line again, which makes what is
# missing, and a comparison with one run. Needs snakemake (`pip install snakemake`).
#
#   docs/examples/cluster/test.sh target/release/crossbar [COMMAND...]
set -euo pipefail
cd "$(dirname "$0")/../../.."
crossbar=$(realpath "${1:-target/release/crossbar}")
shift || true
command=${*:-all-frequency precompute docs/examples/court.obj --ground 24}
rm -rf out/court.npz* out/whole.npz
run() {
  snakemake --snakefile docs/examples/cluster/Snakefile --cores 2 --quiet all "$@" \
    --config crossbar="$crossbar" command="$command" out=out/court.npz parts=6
}
"$crossbar" $command --threads 1 --out out/whole.npz >/dev/null
# The first run ends with the part that was killed.
run &
until part=$(pgrep -f "^$crossbar .* --part 2/6 "); do sleep 0.05; done
kill -s KILL "$part"
if wait $!; then
  echo 'a run with a killed part was accepted' >&2
  exit 1
fi
if test -e out/court.npz.parts/2-of-6 || test -e out/court.npz; then
  echo 'a killed part left a file' >&2
  exit 1
fi
run
cmp out/whole.npz out/court.npz
echo 'the merged file is that of one run'

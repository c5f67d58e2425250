#!/usr/bin/env bash
# Fuzzes every target, or those that are named, each for some seconds: fuzz/run.sh SECONDS [TARGET…]
# With libFuzzer, for which the stable toolchain and a compiler for C++ suffice, or with MOTET_FUZZ_ENGINE=mutate by
# mutated seeds without coverage. The corpus of a target is fuzz/corpora/TARGET, what fails is beside it as crash-…,
# timeout-… or slow-…: copy that to fuzz/corpus, whose files the tests of the workspace replay.
set -euo pipefail
cd "$(dirname "$0")"
seconds=${1:-20}
shift || true
engine=${MOTET_FUZZ_ENGINE:-libfuzzer}
host=$(rustc -vV | sed -n 's/^host: //p')
out=${CARGO_TARGET_DIR:-../target}/$host/fuzz
if [ "$engine" = libfuzzer ]; then
    # What cargo-fuzz sets, but for sanitizers, which need a nightly toolchain and find nothing in safe code.
    coverage='-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 -Cllvm-args=-sanitizer-coverage-trace-compares
        -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table'
    RUSTFLAGS="$(echo $coverage) --cfg fuzzing" cargo build --locked --profile fuzz --target "$host" --features libfuzzer --bin libfuzzer
    names=$(sed -n 's/^    ("\([a-z0-9_]*\)",.*/\1/p' src/targets.rs)
else
    cargo build --locked --profile fuzz --target "$host" --bin mutate
    names=$("$out/mutate")
fi

# Seeds of a target: files of the repository, and those of seeds.txt.
seed() {
    local folder=corpora/$1
    mkdir -p "$folder"
    case $1 in
        document | text | json | check | fix | reply) cp ../examples/*.motet ../examples/*.json "$folder"; cp corpus/* "$folder" ;;
        scene) cp ../robots/scenes/*.json corpus/scene.json "$folder" ;;
        card) cp corpus/robot.toml "$folder"; for card in ../robots/models/*/robot.toml; do cp "$card" "$folder/$(basename "$(dirname "$card")").toml"; done ;;
        urdf) cp ../examples/cart/robot.urdf "$folder" ;;
        xacro) cp ../tests/models/descriptions/*.xacro "$folder" ;;
        profile) cp ../runtime/sim/profiles/*.toml "$folder" ;;
        pddl) for domain in ../tests/pddl/*; do { cat "$domain"/domain.pddl; echo '%%'; cat "$domain"/problem.pddl; } >"$folder/$(basename "$domain")"; done ;;
        ros2_binding) cp ../runtime/ros2/bindings/*.toml "$folder" ;;
        ros2_layouts) cp ../runtime/ros2/layouts/*.layouts "$folder" ;;
        # A message of zeros of each type.
        ros2_message) for type in $(seq 0 120); do { printf "\\x$(printf %x "$type")"; head -c 600 /dev/zero; } >"$folder/zeros_$type"; done ;;
        journal | graph) cp corpus/"$1".* "$folder" ;;
    esac
    awk -v target="$1" -v folder="$folder" '
        /^=== / { wanted = $2 == target; if (wanted) out = folder "/seed_" ++count; next }
        wanted { print > out }' seeds.txt
}

failed=0
for name in ${*:-$names}; do
    seed "$name"
    if [ "$engine" = libfuzzer ]; then
        MOTET_FUZZ=$name "$out/libfuzzer" "corpora/$name" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2000 \
            -max_len=8192 -artifact_prefix="corpora/$name-" -print_final_stats=1 >"corpora/$name.log" 2>&1 || failed=1
        echo "$name: $(grep -Eo 'stat::number_of_executed_units: *[0-9]+|SUMMARY.*|panicked at.*' "corpora/$name.log" | tr -s ' ' | tr '\n' ';')"
    else
        "$out/mutate" "$name" "$seconds" "corpora/$name" 2>"corpora/$name.log" || failed=1
    fi
done
exit $failed

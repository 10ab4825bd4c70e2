# The common part of `run` and `long`, read from the folder of both. `folder`: where each builds,
# below target/. `profile`: `--dev`, or nothing for the optimised build.

TARGETS="scene frames axis odrive cia402 moteus"

# With overflow and debug assertions on. The core forbids unsafe code: what an address
# sanitizer looks for is Miri's part here.
BUILD="$profile --fuzz-dir . --target-dir ../../../target/$folder --sanitizer none"

build_targets() {
    (cd targets && cargo fuzz --version >/dev/null 2>&1) || {
        echo "cargo-fuzz is missing: cargo install --locked cargo-fuzz@0.13.2; it needs g++" >&2
        return 1
    }
    # Of all targets at once, cargo links several side by side.
    [ "$1" != "$TARGETS" ] || set -- ""
    for target in ${1:-""}; do
        # shellcheck disable=SC2086
        (cd targets && cargo fuzz build $BUILD $target)
    done
}

# fuzz TARGET FOLDER OPTIONS…: from the kept inputs; what is new goes to the folder. An input that
# fails is left in tests/fuzz/targets/artifacts.
fuzz() {
    target=$1 new=$2
    shift 2
    if [ -f "$target.dict" ]; then set -- "-dict=../$target.dict" "$@"; fi
    # shellcheck disable=SC2086
    (cd targets && cargo fuzz run $BUILD "$target" "$new" "../corpus/$target" -- \
        -seed=8 -timeout=20 -rss_limit_mb=2048 "$@")
}

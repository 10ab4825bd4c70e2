//! Misuse returns its status, with the sanitizers looking on.

use crate::compile;

#[test]
fn misuse_is_refused_and_nothing_is_written_beside_the_storage() {
    let sanitizers = "-fsanitize=address,undefined";
    let flags = ["-std=c11", "-g", sanitizers, "-fno-sanitize-recover=all"];
    compile::run("cc", &flags, "tests/host/misuse.c");
}

//! Costs of ticks on the target: against the table, within a path, from path to path.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use stillbeam_tests::instructions::{self, Bench, Count};
use stillbeam_tests::{cycles, page, root};

fn bench() -> &'static Bench {
    static BENCH: OnceLock<Bench> = OnceLock::new();
    BENCH.get_or_init(|| instructions::count().unwrap_or_else(|error| panic!("{error}")))
}

fn csv() -> String {
    std::fs::read_to_string(root().join("docs/instructions.csv")).expect("docs/instructions.csv")
}

/// No tick is more than 2 % above `docs/instructions.csv`, and the rows are the same.
#[test]
fn no_tick_has_grown() {
    let found =
        instructions::regressions(bench(), &csv(), 2).unwrap_or_else(|error| panic!("{error}"));
    assert!(
        found.is_empty(),
        "{}\nif this is meant: cargo run --release -p stillbeam-tests --bin instructions",
        found.join("\n")
    );
}

/// The check above can fail: a tick 3 % above the table, a row more, a row less.
#[test]
fn growth_is_found() {
    let mut grown = bench().clone();
    let slow = &mut grown.counts[7];
    slow.worst += slow.worst * 3 / 100 + 1;
    let slow = slow.key.join(",");
    grown.counts[9].key[1] = "99".into();
    let mut found = instructions::regressions(&grown, &instructions::csv(bench()), 2).unwrap();
    found.sort();
    assert_eq!(found.len(), 3, "{found:?}");
    assert!(
        found.iter().any(|line| line.starts_with(&slow) && line.contains("the worst tick grew"))
    );
    assert!(found.iter().any(|line| line.contains(",99,") && line.contains("not in")));
    assert!(found.iter().any(|line| line.contains("no longer counted")));
}

/// Among ticks on the same path, the worst is at most 5 % above the least.
#[test]
fn ticks_on_one_path_cost_the_same() {
    for Count { key, least, worst, .. } in &bench().counts {
        let most = u64::from(*least) * 105;
        assert!(u64::from(*worst) * 100 <= most, "{}: {least} to {worst}", key.join(","));
    }
}

/// Whatever is skipped, the worst tick does not rise.
#[test]
fn no_skip_raises_the_worst_tick() {
    let mut compared = 0;
    for more in &bench().counts {
        for less in &bench().counts {
            let ((path, words), (other, fewer)) = (split(more), split(less));
            let comparable = more.key[..3] == less.key[..3] && path == other;
            if is_lighter_pointwise(more) {
                continue;
            }
            if comparable && fewer.is_subset(&words) && fewer != words {
                compared += 1;
                assert!(
                    more.worst <= less.worst,
                    "{} costs {}, {} only {}",
                    more.key.join(","),
                    more.worst,
                    less.key.join(","),
                    less.worst
                );
            }
        }
    }
    assert!(compared > 100, "{compared}");
}

/// True of the method whose steps a tick follow from the frequencies, which a lighter arm has
/// higher.
fn is_lighter_pointwise(count: &Count) -> bool {
    count.key[0] == "pointwise" && count.key[3].contains("no-payload")
}

/// The path of a row that takes up a segment besides, and the words for what is skipped.
fn split(count: &Count) -> (Option<&str>, BTreeSet<&str>) {
    let path = |word: &&str| ["next-segment", "landing"].contains(word);
    let words = count.key[3].split_whitespace();
    (words.clone().find(path), words.filter(|word| !path(word)).collect())
}

/// A payload and a hub radius are numbers in constants: leaving them out saves nothing and costs
/// nothing.
#[test]
fn payload_and_radius_change_no_operation() {
    let counts = &bench().counts;
    for word in ["no-payload", "no-radius"] {
        let mut compared = 0;
        let without = |count: &&Count| count.key[3].contains(word) && !is_lighter_pointwise(count);
        for without in counts.iter().filter(without) {
            let mut key = without.key.clone();
            key[3] = key[3].split_whitespace().filter(|w| *w != word).collect::<Vec<_>>().join(" ");
            let with = counts.iter().find(|count| count.key == key).expect("the same path");
            compared += 1;
            let (a, b) = ((without.least, without.worst), (with.least, with.worst));
            assert_eq!(a, b, "{}", without.key.join(","));
        }
        assert!(compared > 50, "{word}: {compared}");
    }
}

/// Every skip is there, and each that is said to save saves: a quarter of the tick at rest, half of
/// it asleep, and something without damping, gravity or spin.
#[test]
fn skips_save() {
    let counts = &bench().counts;
    let worst = |method: &str, size: &str, quality: &str, skip: &str| {
        let key = [method, size, quality, skip];
        let count = counts.iter().find(|count| count.key.iter().eq(key.iter()));
        count.unwrap_or_else(|| panic!("no row {key:?}")).worst
    };
    for (method, size, quality) in [
        ("newmark", "1", "consistent"),
        ("newmark", "2", "consistent"),
        ("newmark", "4", "consistent"),
        ("modal", "2", ""),
        ("elastica", "2", "fast"),
    ] {
        let all = worst(method, size, quality, "");
        let plain = worst(method, size, quality, "no-damping no-gravity");
        assert!(worst(method, size, quality, "no-damping") < all, "{method} {size}");
        assert!(worst(method, size, quality, "no-gravity") < all, "{method} {size}");
        assert!(plain < worst(method, size, quality, "no-gravity"), "{method} {size}");
        assert!(worst(method, size, quality, "no-damping no-gravity at-rest") < plain);
        let asleep = worst(method, size, quality, "no-damping no-gravity at-rest asleep");
        assert!(2 * asleep < plain, "{method} {size}: {asleep} of {plain}");
        if method != "elastica" {
            let turning = worst(method, size, quality, "");
            assert!(worst(method, size, quality, "no-spin") < turning, "{method} {size}");
        }
        let rigid = worst("rigid", "0", "", "no-damping no-gravity");
        assert!(2 * rigid < plain, "{method} {size}: rigid {rigid} of {plain}");
    }
}

/// Without an FPU a tick's cost depends on its numbers: the page says so, with the figures of a
/// run, to 2 %.
#[test]
#[ignore = "counts vary with Armv6-M's, of every run: `cargo test --test target -- --ignored`"]
fn the_page_is_right_about_processors_without_an_fpu() {
    the_page_is_right(page::CORTEX_M3, instructions::count_soft());
}

/// The same of the smallest processors.
#[test]
fn the_page_is_right_about_the_smallest_processors() {
    the_page_is_right(page::CORTEX_M0, instructions::count_smallest());
}

/// And on RISC-V.
#[test]
fn the_page_is_right_about_riscv() {
    the_page_is_right(page::RISCV, instructions::count_riscv());
}

/// Traced ticks are the counted ones, an instruction takes at least a cycle, and the page has the
/// estimates.
#[test]
fn cycles_are_estimated_of_what_is_counted() {
    let estimates = cycles::estimate().unwrap_or_else(|error| panic!("{error}"));
    for estimate in &estimates {
        let count = cycles::counted(bench(), estimate).expect("a row of the bench");
        assert_eq!(estimate.instructions, count.worst, "{estimate:?}");
        assert!(estimate.cycles > estimate.instructions, "{estimate:?}");
        assert!(estimate.cycles < 3 * estimate.instructions, "{estimate:?}");
    }
    let page = std::fs::read_to_string(root().join("docs/instructions.md")).unwrap();
    let table = cycles::table(bench(), &estimates);
    assert_eq!(estimates.len(), 10);
    assert!(page.contains(&table), "write the page anew:\n{table}");
}

fn the_page_is_right(processor: &str, soft: Result<Bench, String>) {
    let page = std::fs::read_to_string(root().join("docs/instructions.md")).unwrap();
    let soft = soft.unwrap_or_else(|error| panic!("{error}"));
    let counted = page::without_fpu(processor, &soft);
    let (_, written) = page.split_once(counted.lines().next().unwrap()).expect("its heading");
    let rows = |text: &str| -> Vec<Vec<String>> {
        let rows = text.lines().skip_while(|line| !line.starts_with("| ")).skip(2);
        rows.take_while(|line| line.starts_with('|'))
            .map(|line| line.split('|').map(|cell| cell.trim().to_owned()).collect())
            .collect()
    };
    let (written, counted) = (rows(written), rows(&counted));
    assert!(written.len() == counted.len() && written.len() > 15, "{}", written.len());
    let mut varied = 0;
    for (written, counted) in written.iter().zip(&counted) {
        assert_eq!(written[..4], counted[..4], "write the page anew");
        let number = |cells: &[String], i: usize| -> f64 { cells[i].parse().expect("a number") };
        for i in [4, 5] {
            let (was, is) = (number(written, i), number(counted, i));
            assert!((was - is).abs() <= 0.02 * was, "{written:?} is now {counted:?}");
        }
        let (least, worst) = (number(written, 4), number(written, 5));
        assert_eq!(written[6], format!("{:.0} %", 100.0 * (worst / least - 1.0)));
        varied += u32::from(worst > 1.02 * least);
    }
    assert!(varied > 10, "the claim that ticks vary is about nothing: {varied}");
}

/// The page says that these are not cycles, and has a place for the tables.
#[test]
fn the_page_is_honest_about_its_unit() {
    let page = std::fs::read_to_string(root().join("docs/instructions.md")).unwrap();
    assert!(page.lines().take(6).any(|line| line.contains("instructions, not cycles")));
    page::replace(&page, "").unwrap();
}

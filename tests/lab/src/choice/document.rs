//! `docs/auto.md` and its picture.

use std::fmt::Write as _;

use stillbeam::select::Rung;

use super::judge::{CHANGE, FAR, NEAR, ORDERS, PART, STRICT, STRICT_EACH, TOLERANCE};
use super::random::DISTRIBUTION;
use super::summary::Summary;
use super::verdict::Verdict;
use crate::markers::{self, Block};
use crate::table::{aligned, grouped, quantile};
use stillbeam_sim::error::Error;
use stillbeam_sim::number::{self, Digits};
use stillbeam_sim::plot::{Axis, Chart, Colour, Dash, Series};

/// Borders of the histogram of true error over tolerance.
const BORDERS: [f64; 8] = [0.0, 1e-3, 1e-2, 0.1, 0.5, 0.9, 1.0, f64::INFINITY];

/// Points of a curve in the picture.
const POINTS: usize = 120;

/// Returns the whole page.
pub fn page(seed: u64, verdicts: &[Verdict]) -> String {
    let summary = Summary::of(verdicts);
    let count = summary.arms;
    let blocks = [
        introduction(&summary, seed),
        marked("## Command", &command(seed, count as u64)),
        outcomes(&summary),
        histogram(verdicts),
        "![Share of the choices that err by more](auto.svg)\n".to_owned(),
        rungs(&summary),
        set_up(verdicts),
        marked("## The arms", &distribution(seed)),
        judge(&summary),
    ];
    blocks.join("\n")
}

/// Returns the blocks of the page that depend on the seed and the number of arms alone. They can be
/// checked without the campaign, which takes hours. Both numbers are read from the page.
///
/// # Errors
/// An error is returned if the page does not name its command.
pub fn blocks(page: &str) -> Result<Vec<Block>, Error> {
    let written = markers::block(page, "command")?;
    let number = |option: &str| -> Result<u64, Error> {
        let value = written.split(option).nth(1).and_then(|rest| rest.split_whitespace().next());
        value.and_then(|value| value.parse().ok()).ok_or_else(|| {
            Error::new(format_args!("lab:command: must name the campaign's{option}N"))
        })
    };
    let seed = number(" --seed ")?;
    Ok(vec![command(seed, number(" --count ")?), distribution(seed)])
}

/// Returns a section whose text is a block.
fn marked(heading: &str, Block { name, text }: &Block) -> String {
    format!("{heading}\n\n<!-- lab:{name} -->\n{text}<!-- /lab -->\n")
}

fn command(seed: u64, count: u64) -> Block {
    Block::new(
        "command",
        format!(
            "```sh\ncargo lab auto docs/auto.md --count {count} --seed {seed}\n```\n\nThe same verdicts \
             on any number of cores; `tests/run/auto.rs` judges the first 60 arms of another seed in \
             every test run and asserts both bounds.\n"
        ),
    )
}

fn introduction(summary: &Summary, seed: u64) -> String {
    format!(
        "# How good the choices of `auto` are\n\n\
         `Auto::choose` is given an arm, its moves, the tick and two tolerances: of the tip, a fraction of \
         the link's length, and of the torque, a fraction of its peak. It tries the rungs of a ladder, \
         cheapest tick first, on the moves themselves beside the exact rod in six modes and small steps, \
         takes the first that keeps both tolerances, and says what errors to expect. Torques are \
         compared at the ticks; those less than one and a half ticks from a jump of the commanded \
         acceleration are left out, as in `compare`. Here {} random arms, seed {seed}, are judged by the \
         reference rod of the host, which shares no method with it: {} of {} choices err by more than a \
         tolerance (wanted: fewer than 1 in 1,000), {} are at most one rung above the cheapest that met \
         both (wanted: 99 %). This page is written whole by a command.\n",
        thousands(summary.arms),
        thousands(summary.exceeded),
        thousands(summary.choices()),
        percent(summary.at_most_one_too_dear(), summary.choices()),
    )
}

fn outcomes(summary: &Summary) -> String {
    let choices = summary.choices();
    let mut lines = vec![line("what came out", "arms", "")];
    let mut add = |what: &str, n: usize, of: usize| {
        lines.push(line(what, &thousands(n), &percent(n, of)));
    };
    add("chosen", choices, summary.arms);
    add("… a true error above its tolerance", summary.exceeded, choices);
    add("… of these, the torque's", summary.torque_exceeded, choices);
    add("… the torque is nearer to its tolerance than the tip", summary.torque_decides, choices);
    add("… true error above the expected one", summary.underestimated, choices);
    add("… the cheapest rung that met both tolerances", summary.too_dear[0], choices);
    add("… one rung above it", summary.too_dear[1], choices);
    add("… two rungs or more", choices - summary.at_most_one_too_dear(), choices);
    add("refused: no rung is expected to keep both tolerances", summary.tolerance, summary.arms);
    add("refused: bends too far for the exact kinematics", summary.bends, summary.arms);
    add("refused: the finest rung cannot be set up", summary.other, summary.arms);
    add("… of all refused, a rung met both tolerances", summary.needless, summary.arms);
    format!("## What came out\n\n{}", aligned(&lines))
}

fn histogram(verdicts: &[Verdict]) -> String {
    let ratios: Vec<f64> = ratios(verdicts).map(|[error, _]| error).collect();
    let mut lines = vec![line("true error over tolerance", "choices", "")];
    for pair in BORDERS.windows(2) {
        let n = ratios.iter().filter(|&&ratio| pair[0] < ratio && ratio <= pair[1]).count();
        let what = if pair[1].is_finite() {
            format!("{} to {}", pair[0], pair[1])
        } else {
            format!("above {}", pair[0])
        };
        lines.push(line(&what, &thousands(n), &percent(n, ratios.len())));
    }
    let most = ratios.iter().copied().fold(0.0, f64::max);
    format!("{}\nThe largest is {most:.3}.\n", aligned(&lines))
}

fn rungs(summary: &Summary) -> String {
    let mut lines = vec![line("rung, by cost of a plain tick", "chosen", "cheapest that met it")];
    for (k, rung) in Rung::LADDER.into_iter().enumerate() {
        let [chosen, cheapest] = [summary.chosen[k], summary.cheapest[k]].map(thousands);
        lines.push(line(&rung.to_string(), &chosen, &cheapest));
    }
    format!(
        "## The ladder\n\nThe order is that of the instructions in \
         [instructions.csv](instructions.csv), compared in every test run; with damping or gravity \
         elastica with 1 mode stands before modal with 2, and with 3 modes, fast, before 2, fine.\n\n{}",
        aligned(&lines)
    )
}

fn set_up(verdicts: &[Verdict]) -> String {
    let choices = || verdicts.iter().filter_map(|verdict| verdict.choice.as_ref().ok());
    let mut steps: Vec<u32> = choices().map(|choice| choice.expected.steps).collect();
    let mut a_tick: Vec<f64> = verdicts
        .iter()
        .filter_map(|v| Some(f64::from(v.choice.as_ref().ok()?.expected.steps) / v.ticks as f64))
        .collect();
    steps.sort_unstable();
    a_tick.sort_unstable_by(f64::total_cmp);
    let [some, many] =
        [0.5, 0.99].map(|part| thousands(quantile(&steps, part).unwrap_or(0) as usize));
    let [few, lots] = [0.5, 0.99].map(|part| quantile(&a_tick, part).unwrap_or(0.0));
    format!(
        "## What the choice costs at set-up\n\nIts steps are counted in `Choice::expected.steps`: {some} for the \
         median arm, {many} for all but one in a hundred; {few:.0} and {lots:.0} for each tick of the \
         moves; the exact rod flies once for the first four rungs and once more if none of them is good enough. A step is four evaluations of the six-mode rod, \
         each some 2,400 multiplications and as many additions in f32; the ticks of the rungs beside it \
         are small against that. It was not counted on the target: at two instructions an operation it \
         would be 35,000 a step, a second for 4,800 steps at 168 MHz. It needs no heap. A firmware that \
         knows its moves lets the host choose, `run --method auto`, and links the rung.\n"
    )
}

fn distribution(seed: u64) -> Block {
    let mut text = format!(
        "Arm `i` is drawn with seed {seed} and `i` alone, by \
         `tests/lab/src/choice/random.rs`; periods, lengths, masses, ticks, durations and tolerances \
         uniformly in the logarithm.\n\n"
    );
    for (what, from) in DISTRIBUTION {
        let _ = writeln!(text, "- **{what}**: {from}");
    }
    Block::new("arms", text)
}

fn judge(summary: &Summary) -> String {
    let [first, second, third, fourth] = summary.judged.map(thousands);
    let (least, most) = TOLERANCE;
    format!(
        "## The judge\n\nThe reference rod, first with {} polynomials, then with one more each time until \
         the errors that a verdict hangs on are known. These are the larger of tip and torque over its \
         tolerance, of every rung up to the chosen one, or of all where none was chosen or it did not keep \
         them. The first judge is enough where they all differ from the tolerance by a factor of {FAR}. \
         Otherwise an error counts as known when the last polynomial changed it by at most {CHANGE} of its \
         distance from the tolerance, and by at most {NEAR} of the tolerance where it is below two. {} \
         polynomials did for {first} arms, {} for {second}, {} for {third}, {} were asked for {fourth}; {} \
         arms were still not known then. Every step is shorter than the highest vibration asks for, and its \
         tolerance is {PART:e} of the angle that the arm bends by, {least:e} to {most:e} rad. On every {}th \
         arm all is judged once more with {} polynomials and {:e} a step: over {} arms the errors below \
         twice the tolerance change by at most {:.3} of the tolerance, and {} of the rungs change sides.\n",
        ORDERS[0],
        ORDERS[0],
        ORDERS[1],
        ORDERS[2],
        ORDERS[3],
        thousands(summary.unsettled),
        STRICT_EACH,
        STRICT.order,
        STRICT.tolerance,
        thousands(summary.doubted),
        summary.doubt,
        thousands(summary.turned),
    )
}

/// Draws the share of the choices whose error exceeds a fraction of the tolerance.
pub fn picture(verdicts: &[Verdict]) -> Result<String, Error> {
    let curve = |of: usize| {
        let mut ratios: Vec<f64> = ratios(verdicts).map(|pair| pair[of]).collect();
        ratios.sort_unstable_by(f64::total_cmp);
        let n = ratios.len() as f64;
        (0..=POINTS).filter_map(move |k| {
            let ratio = 10f64.powf(-3.0 + 3.2 * k as f64 / POINTS as f64);
            let above = ratios.len() - ratios.partition_point(|&other| other <= ratio);
            (above > 0).then_some((ratio, above as f64 / n))
        })
    };
    Chart::new(
        "Share of the choices that err by more",
        Axis::log("error over tolerance"),
        Axis::log("share of the choices"),
    )
    .sized(760, 400)
    .with(Series::line("true error", curve(0)))
    .with(Series::line("expected error", curve(1)).dash(Dash::Dashed).colour(Colour::Orange))
    .mark(1.0, "tolerance")
    .svg()
}

/// Returns true and expected error over tolerance of every choice.
fn ratios(verdicts: &[Verdict]) -> impl Iterator<Item = [f64; 2]> {
    verdicts.iter().filter_map(|verdict| {
        let expected = verdict.choice.as_ref().ok()?.expected.excess(&verdict.tolerance);
        Some([verdict.error()?, expected])
    })
}

fn line(a: &str, b: &str, c: &str) -> Vec<String> {
    [a, b, c].map(str::to_owned).to_vec()
}

fn percent(n: usize, of: usize) -> String {
    number::percent(n as f64, of as f64, Digits::Decimals(2))
}

fn thousands(n: usize) -> String {
    grouped(n as u64)
}

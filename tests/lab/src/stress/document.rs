//! The campaigns as the blocks of `docs/stability.md`.

use std::collections::BTreeMap;

use super::draw::RANGES;
use super::energy::Ring;
use super::long;
use super::summary::{Summary, bound};
use crate::table::{aligned, grouped};
use stillbeam_sim::error::Error;

/// Names of the blocks: [`scenes`], [`reasons`], [`precision`], [`energy()`], [`long()`].
pub const NAMES: [&str; 5] = ["scenes", "reasons", "precision", "energy", "long"];

fn words<const N: usize>(line: [&str; N]) -> Vec<String> {
    line.map(str::to_owned).to_vec()
}

/// Lists the ranges that are drawn.
pub fn ranges() -> String {
    let mut lines = vec![words(["quantity", "drawn from"])];
    lines.extend(RANGES.map(|(quantity, range)| words([quantity, range])));
    aligned(&lines)
}

/// Lists the results of the scenes, method by method.
pub fn scenes(summary: &Summary) -> String {
    let header = ["method", "ran", "swings up", "refused", "panics", "not finite", "off target"];
    let mut lines = vec![words(header)];
    for (name, counts) in &summary.methods {
        let mut line = vec![name.clone()];
        line.extend(
            [
                counts.ran,
                counts.rings_up,
                counts.refused,
                counts.panicked,
                counts.not_finite,
                counts.off_target,
            ]
            .map(grouped),
        );
        lines.push(line);
    }
    let mut text = format!(
        "`cargo lab stress --count {} --seed {}`: {} ticks.\n\n{}",
        summary.scenes,
        summary.seed,
        grouped(summary.ticks),
        aligned(&lines)
    );
    if !summary.failures.is_empty() {
        text.push('\n');
    }
    for failure in &summary.failures {
        text += &format!("- scene {}, {}: {}\n", failure.index, failure.method, failure.what);
    }
    text
}

/// Lists the refusals by reason, numbers left out.
pub fn reasons(summary: &Summary) -> String {
    let mut reasons: Vec<(&String, &u64)> = summary.reasons.iter().collect();
    reasons.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
    let mut lines = vec![words(["refused", "because"])];
    lines.extend(reasons.iter().map(|(reason, count)| vec![grouped(**count), (*reason).clone()]));
    aligned(&lines)
}

/// Compares f32 with f64 by decade of condition, and with the bound.
pub fn precision(summary: &Summary) -> String {
    let decades: Vec<String> = (0..8).map(|decade| format!("10^{decade}")).collect();
    let mut header = words(["method"]);
    header.extend(decades);
    header.push("bound".to_owned());
    header.push("above it".to_owned());
    let mut lines = vec![header];
    for (name, counts) in &summary.methods {
        if name == "rigid" {
            continue;
        }
        let mut line = vec![name.clone()];
        for decade in 0..8 {
            line.push(
                counts.deflection.get(&decade.to_string()).map_or("\u{2013}".into(), |spread| {
                    format!("{:.0e} / {:.0e}", spread.quantile(0.5), spread.most)
                }),
            );
        }
        line.push(format!("{:.0e}", bound(name)));
        line.push(grouped(counts.above));
        lines.push(line);
    }
    aligned(&lines)
}

/// Edges of the ranges of `ω₁h` for which the energy is given.
const EDGES: [f64; 4] = [0.0, 0.1, 0.5, f64::INFINITY];

/// Lists growth and loss of the energy by method and range of `ω₁h`.
pub fn energy(rings: &[Ring]) -> String {
    let mut by_method: BTreeMap<&str, Vec<&Ring>> = BTreeMap::new();
    for ring in rings {
        by_method.entry(&ring.method).or_default().push(ring);
    }
    let mut header = words(["method", "arms"]);
    header.push(format!("within {GROWTH:.0e}"));
    for range in ["to 0.1", "0.1 to 0.5", "above"] {
        header.push(format!("growth, ω₁h {range}"));
        header.push("loss, median".to_owned());
    }
    header.push("largest growth at scene".to_owned());
    let mut lines = vec![header];
    for (method, rings) in by_method {
        let kept = rings.iter().filter(|ring| ring.growth <= GROWTH).count();
        let mut line = vec![method.to_owned(), rings.len().to_string(), kept.to_string()];
        for edge in EDGES.windows(2) {
            let within: Vec<&&Ring> =
                rings.iter().filter(|ring| (edge[0]..edge[1]).contains(&ring.turn)).collect();
            let growth = within.iter().map(|ring| ring.growth).reduce(f64::max);
            let mut losses: Vec<f64> = within.iter().map(|ring| ring.loss).collect();
            losses.sort_by(f64::total_cmp);
            let figure = |x: Option<&f64>| x.map_or("\u{2013}".into(), |x| format!("{x:.0e}"));
            line.push(figure(growth.as_ref()));
            line.push(figure(losses.get(losses.len() / 2)));
        }
        let worst = rings.iter().max_by(|a, b| a.growth.total_cmp(&b.growth));
        line.push(match worst {
            Some(ring) if ring.growth > 0.0 => format!("{} ({:.1e})", ring.scene, ring.turn),
            _ => "\u{2013}".into(),
        });
        lines.push(line);
    }
    aligned(&lines)
}

/// Largest growth of the energy that is wanted.
const GROWTH: f64 = 1e-3;

/// First modes that ring on, rad a tick.
const TURNS: [f64; 5] = [1e-3, 1e-2, 0.1, 1.0, 3.0];

/// Returns the ticks of [`long()`] in all.
pub fn long_ticks(ticks: u64) -> u64 {
    (3 + TURNS.len() as u64 + 1) * ticks
}

/// Makes long runs of `ticks` ticks each and lists their results.
pub fn long(ticks: u64, done: &dyn Fn(u64)) -> Result<String, Error> {
    let mut lines =
        vec![words(["repeated moves", "ticks", "stops", "off the last bit", "drift, of the peak"])];
    for run in long::shuttles(ticks, done)? {
        lines.push(vec![
            run.method.to_owned(),
            grouped(run.ticks),
            grouped(run.stops),
            grouped(run.missed),
            format!("{:.1e}", run.drift),
        ]);
    }
    let mut text = aligned(&lines);
    let mut lines =
        vec![words(["an undamped mode, ω₁h", "ticks", "phase slip, rad a rad", "amplitude left"])];
    for run in long::ringing(&TURNS, ticks, done)? {
        lines.push(vec![
            run.turn.to_string(),
            grouped(run.ticks),
            format!("{:.1e}", run.slip),
            format!("{:.5}", run.amplitude),
        ]);
    }
    text += &format!("\n{}", aligned(&lines));
    let run = long::rotation(7.3, ticks, done)?;
    text += &format!(
        "\nA hub that turns at 7.3 rad/s for {} ticks, {:.0} turns: no angle is further than {:.1e} \
         turn from the exact one, no tick's turn further than {:.1e}.\n",
        grouped(run.ticks),
        run.turns,
        run.off,
        run.uneven
    );
    Ok(text)
}

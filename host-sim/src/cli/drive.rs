//! `drive`: lets a drive and its machine follow a scene, with less and with more feed-forward.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde::Serialize;
use stillbeam_sim::console::open;
use stillbeam_sim::error::Error;
use stillbeam_sim::servo::bench::Feed;
use stillbeam_sim::servo::trials::{Outcome, Report, Trial};
use stillbeam_sim::servo::{Between, Machine, Protocol, page};
use stillbeam_sim::{println, progress};

use super::tick::TickArgs;

#[derive(clap::Args)]
pub struct DriveArgs {
    /// Scene file, or the name of an embedded scene
    scene: String,
    /// Machine file: motor, gear, friction, encoder, and the drive's gains; or odrive-tuned,
    /// moteus-tuned, cia402-tuned, geared [default: a direct drive with a little friction on an
    /// ODrive with its own gains]
    #[arg(long, value_name = "FILE")]
    machine: Option<String>,
    /// Another drive, with its own gains: odrive, moteus or cia402
    #[arg(long, value_name = "NAME")]
    drive: Option<String>,
    /// Way between setpoints: hold, extrapolate, linear or hermite [default: the drive's own]
    #[arg(long, value_name = "WAY")]
    between: Option<String>,
    #[command(flatten)]
    tick: TickArgs,
    /// Folder for the page, its pictures and the runs
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print one JSON object, for programs
    #[arg(long)]
    json: bool,
    /// Show the page in the browser
    #[arg(long)]
    open: bool,
}

impl DriveArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        super::refuse_to_open(self.open, self.out.as_deref(), "--out DIR")?;
        let scene = self.tick.applied(open(&self.scene)?);
        let machine = self.machine()?;
        let trials = Trial::all(&scene.arm);
        let bar = progress::bar("runs", trials.len());
        let report = Report::of(&scene, &machine, &trials, &|| bar.inc(1));
        bar.finish_and_clear();
        let report = report?;
        for line in scene.deduced.lines() {
            super::note(&line);
        }
        if let Some(reason) = &report.no_still {
            super::note(&format!("no still moves: {reason}"));
        }
        let title = format!(
            "{} on {}, a setpoint every {} ms",
            scene.name,
            machine.drive.name(),
            1e3 * report.tick
        );
        let folder = self.out.as_deref();
        let file = folder.map(|folder| page::write(folder, &title, &report)).transpose()?;
        if self.json {
            let figures = Figures::of(&scene.name, &machine, &report, file.as_deref());
            super::print_json(&figures)?;
        } else {
            println!("{title}");
            print(&report);
            println!("{}", report.conclusion());
            if let Some(file) = &file {
                println!("  {}", file.display());
            }
            draw(&report);
        }
        if let Some(file) = file.filter(|_| self.open) {
            super::show(&file);
        }
        Ok(ExitCode::SUCCESS)
    }

    fn machine(&self) -> Result<Machine, Error> {
        let mut machine = match &self.machine {
            Some(name) => Machine::open(name)?,
            None => Machine::default(),
        };
        if let Some(name) = &self.drive {
            machine.drive = Protocol::named(name).ok_or_else(|| {
                let known = Protocol::NAMES.join(", ");
                Error::new(format_args!("--drive = {name}: must be one of {known}"))
            })?;
        }
        if let Some(name) = &self.between {
            let between = Between::ALL.into_iter().find(|way| way.name() == name);
            let between = between.ok_or_else(|| {
                let known = Between::ALL.map(Between::name).join(", ");
                Error::new(format_args!("--between = {name}: must be one of {known}"))
            })?;
            machine.drive = machine.drive.with_between(between);
        }
        Ok(machine)
    }
}

/// Figures of all trials, for programs.
#[derive(Serialize)]
struct Figures<'a> {
    scene: &'a str,
    drive: &'static str,
    tick_s: f64,
    trials: Vec<Row>,
    /// Reason why there are no still moves, if so.
    no_still: Option<String>,
    conclusion: String,
    page: Option<&'a Path>,
}

/// Figures of one trial. Distances of the tip are fractions of L.
#[derive(Serialize)]
struct Row {
    sent: String,
    hub_rad: f64,
    tip: f64,
    residual: f64,
    /// Residual of the same arm whose hub follows exactly.
    exact_residual: f64,
    /// Largest distance of the tip from where it is to rest, after arrival.
    off: f64,
    torque_nm: f64,
    /// Fraction of the time in which the motor could not give what was asked for.
    saturated: f64,
}

impl<'a> Figures<'a> {
    fn of(scene: &'a str, machine: &Machine, report: &Report, page: Option<&'a Path>) -> Self {
        Self {
            scene,
            drive: machine.drive.name(),
            tick_s: report.tick,
            trials: report.outcomes.iter().map(Row::of).collect(),
            no_still: report.no_still.as_ref().map(Error::to_string),
            conclusion: report.conclusion(),
            page,
        }
    }
}

impl Row {
    fn of(outcome: &Outcome) -> Self {
        let judged = &outcome.judged;
        Self {
            sent: outcome.trial.describe(),
            hub_rad: judged.hub,
            tip: judged.tip,
            residual: judged.residual,
            exact_residual: outcome.exact,
            off: judged.off,
            torque_nm: judged.torque,
            saturated: judged.saturated,
        }
    }
}

/// Draws the hub's error over time with positions alone and with all that can be sent, if standard
/// output is a terminal.
fn draw(report: &Report) {
    let trials = [Trial { feed: Feed::POSITION, ..Trial::PLAIN }, Trial::PLAIN];
    for outcome in trials.iter().filter_map(|trial| report.find(trial)) {
        let errors = page::hub_error(report, outcome);
        let end = errors.last().map_or(0.0, |(t, _)| (1e3 * t).round() / 1e3);
        let title = format!("hub behind its command, mrad; sent: {}", outcome.trial.describe());
        let values = errors.into_iter().map(|(_, error)| 1e3 * error).collect();
        super::draw([(title.as_str(), values)], end);
    }
}

fn print(report: &Report) {
    let rows: Vec<Vec<String>> = report.outcomes.iter().map(page::cells).collect();
    let heads: Vec<String> = page::HEADER.iter().map(|head| (*head).to_owned()).collect();
    let width = |column: usize| {
        let cells = rows.iter().chain([&heads]).map(|row| row[column].chars().count());
        cells.max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..heads.len()).map(width).collect();
    for row in [&heads].into_iter().chain(&rows) {
        let mut line = format!("  {:<w$}", row[0], w = widths[0]);
        for (cell, width) in row.iter().zip(&widths).skip(1) {
            line += &format!("  {cell:>width$}");
        }
        println!("{line}");
    }
}

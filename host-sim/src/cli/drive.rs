//! `drive`: lets a drive and its machine follow a scene, with less and with more feed-forward.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_sim::console::open;
use stillbeam_sim::error::Error;
use stillbeam_sim::servo::trials::{Report, Trial};
use stillbeam_sim::servo::{Between, Machine, Protocol, page};
use stillbeam_sim::{println, progress};

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
    /// Folder for the page, its pictures and the runs
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl DriveArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let scene = open(&self.scene)?;
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
        println!("{title}");
        print(&report);
        println!("{}", report.conclusion());
        if let Some(folder) = &self.out {
            println!("  {}", page::write(folder, &title, &report)?.display());
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

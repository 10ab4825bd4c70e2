//! `new`: writes a scene to start from, and says what arm it is.

use std::fmt::Display;
use std::io::{IsTerminal, stderr, stdin};
use std::path::PathBuf;
use std::process::ExitCode;

use dialoguer::{Input, Select};
use stillbeam::material::MATERIALS;
use stillbeam_sim::arm::describe;
use stillbeam_sim::error::Error;
use stillbeam_sim::number::short_percent;
use stillbeam_sim::output::write_whole;
use stillbeam_sim::println;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::starter::{Starter, doubts};
use stillbeam_sim::table::significant;

#[derive(clap::Args)]
pub struct NewArgs {
    /// File for the scene, which must not exist yet
    #[arg(value_name = "SCENE.toml", default_value = "arm.toml")]
    out: PathBuf,
    /// Length of the link from the clamp to the tip, m
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    length: Option<f64>,
    /// Material of the link
    #[arg(long, value_name = "NAME")]
    material: Option<String>,
    /// Width of the strip, across the plane of motion, m
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    width: Option<f64>,
    /// Thickness of the strip, in the plane of motion, m
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    thickness: Option<f64>,
    /// Payload at the tip, kg
    #[arg(long, value_name = "KG", allow_negative_numbers = true)]
    payload: Option<f64>,
    /// First frequency as measured, payload on and hub held, Hz [default: by the material]
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    frequency: Option<f64>,
    /// Damping ratio of the first mode as measured [default: none]
    #[arg(long, value_name = "RATIO", allow_negative_numbers = true)]
    damping: Option<f64>,
    /// Hub angle at the end of the move, rad
    #[arg(long, value_name = "RAD", default_value = "1.5708", allow_negative_numbers = true)]
    to: f64,
    /// Duration of the move, s [default: two first periods]
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    duration: Option<f64>,
}

impl NewArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        if self.out.exists() {
            return Err(Error::file(&self.out, "exists; must be a new file's path"));
        }
        let out = self.out.clone();
        let starter = self.complete()?;
        let name = out.display().to_string();
        let text = starter.text(&name)?;
        let scene = SceneFile::parse(&name, &text)?;
        let report = describe(&scene)?;
        let doubts = match starter.frequency {
            None => doubts(&starter)?,
            Some(_) => Vec::new(),
        };
        write_whole(&out, |file| file.write_all(text.as_bytes()))?;
        super::arm::print(&report);
        for (index, doubt) in doubts.iter().enumerate() {
            println!(
                "  {:<10} {} moves the first frequency by {}",
                if index == 0 { "in doubt" } else { "" },
                doubt.what,
                short_percent(doubt.shift, 2)
            );
        }
        if !doubts.is_empty() {
            let expected = significant(report.frequency_hz[0], 4);
            println!(
                "  measure    the first frequency, expected at {expected} Hz: tap the arm, hub held, and"
            );
            println!("             give `identify` the log, or write link.frequency into the file");
        }
        println!("  next       stillbeam-sim run {name} --csv setpoints.csv");
        Ok(ExitCode::SUCCESS)
    }

    /// Asks for what no flag has given.
    ///
    /// # Errors
    /// Without a terminal, an error that names what is missing.
    fn complete(self) -> Result<Starter, Error> {
        let missing: Vec<&str> = [
            ("--length", self.length.is_none()),
            ("--material", self.material.is_none()),
            ("--width", self.width.is_none()),
            ("--thickness", self.thickness.is_none()),
            ("--payload", self.payload.is_none()),
        ]
        .into_iter()
        .filter_map(|(flag, missing)| missing.then_some(flag))
        .collect();
        let can_ask = stdin().is_terminal() && stderr().is_terminal();
        if !missing.is_empty() && !can_ask {
            return Err(Error::new(format_args!(
                "{}: missing; must be given where no terminal is there to ask on",
                missing.join(", ")
            )));
        }
        Ok(Starter {
            length: asked(self.length, "Length of the link, clamp to tip, m", 0.5)?,
            material: self.material.map_or_else(material, Ok)?,
            width: asked(self.width, "Width of the strip, m", 0.02)?,
            thickness: asked(self.thickness, "Thickness, in the plane of motion, m", 0.002)?,
            payload: asked(self.payload, "Payload at the tip, kg", 0.05)?,
            frequency: self.frequency,
            damping: self.damping,
            to: self.to,
            duration: self.duration,
        })
    }
}

/// Asks for a number unless it is given.
fn asked(given: Option<f64>, question: &str, usual: f64) -> Result<f64, Error> {
    match given {
        Some(value) => Ok(value),
        None => {
            Input::new().with_prompt(question).default(usual).interact_text().map_err(broken_off)
        }
    }
}

/// Asks for a material of the core's table.
fn material() -> Result<String, Error> {
    let names = MATERIALS.map(|material| material.name);
    let usual = names.iter().position(|name| *name == "aluminium").unwrap_or(0);
    let select = Select::new().with_prompt("Material").items(names).default(usual);
    select.interact().map(|index| names[index].to_owned()).map_err(broken_off)
}

fn broken_off(cause: impl Display) -> Error {
    Error::new(format_args!("{cause}; must be answered, or be given as flags; nothing is written"))
}

//! `talk`: a conversation with the firmware.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use stillbeam_sim::error::Error;
use stillbeam_sim::output::Files;
use stillbeam_sim::talk::{
    self, DEMONSTRATION, Excitation, MACHINE, Machine, Recording, Session, Step,
};
use stillbeam_sim::{output, println};

#[derive(clap::Args)]
pub struct TalkArgs {
    /// Steps, each in quotes, e.g. "enable 0" "move 0 quintic 0.8 1.57" rest; a demonstration
    /// without any
    steps: Vec<String>,
    /// The application's image, to be run in QEMU [default: where cargo builds it]
    #[arg(long, value_name = "FILE", conflicts_with = "serial")]
    image: Option<PathBuf>,
    /// A board's serial port, instead of QEMU
    #[arg(long, value_name = "PORT")]
    serial: Option<String>,
    /// The reference rod behind motor, gear and friction on every drive, in QEMU; the steps may
    /// then be "jump A TURNS" of the encoder too
    #[arg(long, conflicts_with = "serial")]
    plant: bool,
    /// Repeat the steps until so many seconds of virtual time have passed; in QEMU
    #[arg(long = "for", value_name = "SECONDS", conflicts_with = "serial")]
    seconds: Option<f64>,
    /// Baud rate of the serial port
    #[arg(long, default_value_t = 921_600)]
    baud: u32,
    /// File for a page with the setpoints
    #[arg(long, value_name = "OUT.html")]
    plot: Option<PathBuf>,
    /// Log for `identify`, of hub angle and sensor: behind the steps, if any, the axis is switched
    /// on, moved and switched off
    #[arg(long, value_name = "LOG.csv")]
    record: Option<PathBuf>,
    /// Axis to be recorded
    #[arg(long, value_name = "A", default_value_t = 0, requires = "record")]
    axis: u8,
    /// Motion of its hub
    #[arg(long, value_enum, default_value = "cubic", requires = "record")]
    motion: Excitation,
    /// Largest angle of its hub from where it is, rad [default: what the limits allow, at most 0.1
    /// of cubics and 0.03 of a sweep]
    #[arg(long, value_name = "RAD", allow_negative_numbers = true, requires = "record")]
    turn: Option<f64>,
}

impl TalkArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let steps: Vec<&str> = match self.steps.as_slice() {
            [] if self.record.is_some() => Vec::new(),
            [] if self.plant => MACHINE.to_vec(),
            [] => DEMONSTRATION.to_vec(),
            steps => steps.iter().map(String::as_str).collect(),
        };
        // Bad words are refused before anything starts.
        for text in &steps {
            text.parse::<Step>()?;
        }
        if let Some(path) = &self.record {
            // A log that cannot be written is refused before the arm moves; this file is dropped.
            Files::default().add(path, |_| Ok(()))?;
        }
        let machine = match &self.serial {
            Some(port) => Machine::open(port, self.baud)?,
            None => Machine::emulate(&self.image.clone().unwrap_or_else(talk::default_image))?,
        };
        let mut session =
            if self.plant { Session::begin_loaded(machine)? } else { Session::begin(machine)? };
        let print = &mut |line: &str| println!("{line}");
        match self.seconds {
            Some(seconds) => talk::endure(&mut session, &steps, seconds, print)?,
            // A recording alone has steps of its own.
            None if steps.is_empty() => {}
            None => talk::converse(&mut session, &steps, print)?,
        }
        if let Some(path) = &self.record {
            self.log(&mut session, path)?;
        }
        if let Some(path) = &self.plot {
            let page = talk::page(&session)?;
            output::write_whole(path, |file| file.write_all(page.as_bytes()))?;
            println!("drawn in {}", path.display());
        }
        Ok(ExitCode::SUCCESS)
    }

    /// Records an axis and writes its log, whole or not at all.
    fn log(&self, session: &mut Session, path: &Path) -> Result<(), Error> {
        let recording = talk::record(session, self.axis, self.motion, self.turn)?;
        output::write_whole(path, |file| recording.write(file))?;
        let Recording { column, samples, lost } = &recording;
        let count = samples.len();
        println!("axis {}: {count} samples of {column} in {}", self.axis, path.display());
        if *lost > 0 {
            println!(
                "warning: {lost} samples are missing in between; the line was too slow for them, or \
                 the drive silent"
            );
        }
        Ok(())
    }
}

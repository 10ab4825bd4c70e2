//! `talk`: a conversation with the firmware.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_sim::error::Error;
use stillbeam_sim::talk::{self, DEMONSTRATION, MACHINE, Machine, Session, Step};
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
}

impl TalkArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let steps: Vec<&str> = match self.steps.as_slice() {
            [] if self.plant => MACHINE.to_vec(),
            [] => DEMONSTRATION.to_vec(),
            steps => steps.iter().map(String::as_str).collect(),
        };
        // Bad words are refused before anything starts.
        for text in &steps {
            text.parse::<Step>()?;
        }
        let machine = match &self.serial {
            Some(port) => Machine::open(port, self.baud)?,
            None => Machine::emulate(&self.image.unwrap_or_else(talk::default_image))?,
        };
        let mut session =
            if self.plant { Session::begin_loaded(machine)? } else { Session::begin(machine)? };
        let print = &mut |line: &str| println!("{line}");
        match self.seconds {
            Some(seconds) => talk::endure(&mut session, &steps, seconds, print)?,
            None => talk::converse(&mut session, &steps, print)?,
        }
        if let Some(path) = &self.plot {
            let page = talk::page(&session)?;
            output::write_whole(path, |file| file.write_all(page.as_bytes()))?;
            println!("drawn in {}", path.display());
        }
        Ok(ExitCode::SUCCESS)
    }
}

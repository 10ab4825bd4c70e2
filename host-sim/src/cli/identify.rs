//! `identify`: finds an arm's frequencies and damping in a measured log, and writes a scene.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use stillbeam_sim::error::Error;
use stillbeam_sim::identify::arm::{Free, Sensor};
use stillbeam_sim::identify::forced::Lowpass;
use stillbeam_sim::identify::log::{Columns, Kind, Sign};
use stillbeam_sim::identify::report::{ArmFit, Report};
use stillbeam_sim::identify::{Identified, Request, page as document, scene};
use stillbeam_sim::number::Digits;
use stillbeam_sim::output::Files;
use stillbeam_sim::table::significant;
use stillbeam_sim::{println, scenes};

#[derive(clap::Args)]
pub struct IdentifyArgs {
    /// Logs as CSV; of several the last is held out for validation
    #[arg(required = true, value_name = "LOG.csv")]
    logs: Vec<PathBuf>,
    /// Scene of the arm as documented: a file, which needs no moves, or an embedded scene
    #[arg(long, value_name = "ARM.toml")]
    scene: Option<String>,
    /// Scene to be written with the fitted values, and a page beside it
    #[arg(long, value_name = "FITTED.toml", requires = "scene")]
    out: Option<PathBuf>,
    /// Page to be written: log and fit, residual, spectrum [default: beside --out]
    #[arg(long, value_name = "PAGE.html")]
    page: Option<PathBuf>,
    /// Print one JSON object, for programs
    #[arg(long)]
    json: bool,
    /// Show the page in the browser
    #[arg(long)]
    open: bool,
    /// Column of the time [default: t_s, time, timestamp, …]; _s, _ms, _us, _ns tell the unit
    #[arg(long, value_name = "COLUMN")]
    time: Option<String>,
    /// Column of the hub's angle [default: hub_angle_rad if there is one; without it the log is a
    /// ring-down]
    #[arg(long, value_name = "COLUMN")]
    hub: Option<String>,
    /// Column of the sensor [default: the only other one, or tip_…, deflection…, strain…]
    #[arg(long, value_name = "COLUMN")]
    sensor: Option<String>,
    /// Quantity that the sensor measures [default: as the ending of the column's name says]
    #[arg(long, value_enum)]
    kind: Option<Kind>,
    /// Direction of the sensor: - if it counts against the hub's angle
    #[arg(long, value_enum, default_value = "+", allow_hyphen_values = true)]
    sign: Sign,
    /// Beginning of the part that is used, s from the first row
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    from: Option<f64>,
    /// End of the part that is used, s from the first row
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    to: Option<f64>,
    /// Number of modes, 1 to 3 [default: what a ring-down shows, 1 with a hub's angle]
    #[arg(long, value_name = "N")]
    modes: Option<usize>,
    /// Known second-order low-pass of the sensor: corner in Hz, damping ratio
    #[arg(
        long,
        value_name = "HZ,ZETA",
        value_delimiter = ',',
        num_args = 1,
        allow_negative_numbers = true
    )]
    sensor_lowpass: Option<Vec<f64>>,
    /// Place of a sensor that is not in the scene, m from the clamp
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    sensor_at: Option<f64>,
    /// Mass of that sensor, kg
    #[arg(long, value_name = "KG", allow_negative_numbers = true)]
    sensor_mass: Option<f64>,
    /// Parameters of the scene that are fitted to the frequencies, as many as there are modes at
    /// most [default: stiffness]
    #[arg(long, value_enum, value_delimiter = ',')]
    free: Vec<Free>,
}

impl IdentifyArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let page = self.page_path();
        super::refuse_to_open(self.open, page.as_deref(), "--page or --out")?;
        let scene = self.scene.as_deref().map(stillbeam_sim::console::open_arm).transpose()?;
        let request = Request {
            logs: self.logs.clone(),
            columns: Columns {
                time: self.time.clone(),
                hub: self.hub.clone(),
                sensor: self.sensor.clone(),
                kind: self.kind,
            },
            sign: self.sign,
            from: self.from,
            to: self.to,
            modes: self.modes,
            lowpass: self.lowpass()?,
            sensor: self.mounted()?,
            free: self.free.clone(),
            scene: scene.map(|scene| (scene.name, scene.arm)),
        };
        let identified = request.carry_out()?;
        let written = self.write(&identified, page.as_deref())?;
        if self.json {
            super::print_json(&identified.report)?;
        } else {
            print(&identified.report);
            for path in written {
                println!("  {}", path.display());
            }
        }
        if let Some(page) = page.filter(|_| self.open) {
            super::show(&page);
        }
        Ok(ExitCode::SUCCESS)
    }

    fn lowpass(&self) -> Result<Option<Lowpass>, Error> {
        match self.sensor_lowpass.as_deref() {
            None => Ok(None),
            Some(&[frequency, ratio]) => Ok(Some(Lowpass { frequency, ratio })),
            Some(other) => Err(Error::new(format_args!(
                "--sensor-lowpass: {} numbers; must be two, a corner in Hz and a damping ratio: 2,0.9",
                other.len()
            ))),
        }
    }

    fn mounted(&self) -> Result<Option<Sensor>, Error> {
        match (self.sensor_at, self.sensor_mass) {
            (Some(at), Some(mass)) => Ok(Some(Sensor { at, mass })),
            (None, None) => Ok(None),
            _ => Err(Error::new(
                "--sensor-at and --sensor-mass: one is missing; must be given together",
            )),
        }
    }

    /// Returns the page's path, if one is to be written.
    fn page_path(&self) -> Option<PathBuf> {
        let beside = self.out.as_deref().map(|out| out.with_extension("html"));
        self.page.clone().or(beside)
    }

    /// Writes the scene and the page, both or none.
    fn write(&self, identified: &Identified, page: Option<&Path>) -> Result<Vec<PathBuf>, Error> {
        let mut files = Files::default();
        if let (Some(out), Some(name), Some(arm)) = (&self.out, &self.scene, &identified.arm) {
            let text =
                scene::fitted(&scenes::text(name)?, arm, &self.free, &identified.report.logs)?;
            files.add(out, |file| file.write_all(text.as_bytes()))?;
        }
        if let Some(path) = page {
            let title = self.scene.clone().unwrap_or_else(|| name_of(&self.logs[0]));
            let text = document::text(&title, identified)?;
            files.add(path, |file| file.write_all(text.as_bytes()))?;
        }
        files.finish()
    }
}

fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

fn print(report: &Report) {
    println!("{}: {}", report.logs.join(", "), report.case);
    println!(
        "  sensor      {} in {}, {:.3} to {:.3} s of the log",
        report.sensor, report.unit, report.used_s[0], report.used_s[1]
    );
    println!("  mode  frequency Hz  95 % interval            damping %  95 % interval");
    for (index, mode) in report.modes.iter().enumerate() {
        let [low, high] = mode.frequency_interval_hz;
        let [light, heavy] = mode.damping_interval.map(|ratio| 100.0 * ratio);
        println!(
            "  {:<4}  {:>12.4}  {low:>10.4} to {high:<10.4}  {:>9.4}  {light:.4} to {heavy:.4}",
            index + 1,
            mode.frequency_hz,
            100.0 * mode.damping_ratio
        );
    }
    let main = &report.modes[0];
    println!(
        "  seen at     {} to {} {}, {:.0} periods of the first mode",
        Digits::Three.show(main.amplitude[0]),
        Digits::Three.show(main.amplitude[1]),
        report.unit,
        main.periods
    );
    println!(
        "  fit         {:.2} % of what was fitted, {:.2} % of what was held out",
        report.fit_percent, report.validation_percent
    );
    if let (Some(delay), Some(scale)) = (report.delay_s, report.scale) {
        println!(
            "  sensor      {} {} per rad, {:.1} ms late, {} {} at rest",
            digits(scale),
            report.unit,
            1e3 * delay,
            digits(report.offset),
            report.unit
        );
    }
    if let Some(arm) = &report.arm {
        print_arm(arm);
    }
    for warning in &report.warnings {
        println!("  warning     {warning}");
    }
}

fn print_arm(arm: &ArmFit) {
    for value in &arm.values {
        let against = match (value.documented, value.change_percent()) {
            (Some(documented), Some(change)) => {
                let side = if change < 0.0 { "below" } else { "above" };
                let documented = digits(documented);
                format!(", {:.1} % {side} the scene\u{2019}s {documented}", change.abs())
            }
            _ => String::new(),
        };
        println!(
            "  fitted      {} = {} {} ({} to {}){against}",
            value.key,
            digits(value.fitted),
            value.unit,
            digits(value.interval[0]),
            digits(value.interval[1])
        );
    }
    let hz =
        |list: &[f64]| list.iter().map(|hz| digits(*hz).to_string()).collect::<Vec<_>>().join(", ");
    println!(
        "  scene       {} Hz as documented, {} Hz as fitted",
        hz(&arm.documented_frequency_hz),
        hz(&arm.fitted_frequency_hz)
    );
    println!(
        "  damping     alpha = {} 1/s, beta = {} s",
        digits(arm.alpha_per_s),
        digits(arm.beta_s)
    );
}

fn digits(value: f64) -> f64 {
    significant(value, 4)
}

//! `arm`: says what a scene's arm is.

use std::process::ExitCode;

use stillbeam_sim::arm::{ArmReport, MethodReport, describe};
use stillbeam_sim::console::open_arm;
use stillbeam_sim::error::Error;
use stillbeam_sim::number::short_percent;
use stillbeam_sim::println;
use stillbeam_sim::table::significant;

use super::tick::TickArgs;

#[derive(clap::Args)]
pub struct ArmArgs {
    /// Scene file, or the name of an embedded scene; a file needs no moves here
    scene: String,
    #[command(flatten)]
    tick: TickArgs,
    /// Print one JSON object, for programs
    #[arg(long)]
    json: bool,
}

impl ArmArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let scene = self.tick.applied(open_arm(&self.scene)?);
        let report = describe(&scene)?;
        if self.json {
            super::print_json(&report)?;
        } else {
            print(&report);
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// Prints what an arm is.
pub fn print(report: &ArmReport) {
    println!("{}", report.scene);
    let shape = if report.is_uniform { "" } else { " as if uniform" };
    println!(
        "  link       {}, {}, EI {} N m\u{b2}{shape}",
        metres(report.length_m),
        kilograms(report.link_mass_kg),
        digits(report.bending_stiffness_nm2)
    );
    if report.mounted_mass_kg > 0.0 {
        println!("  mounted    {} on the link", kilograms(report.mounted_mass_kg));
    }
    if report.payload_mass_kg > 0.0 {
        let place = match report.payload_offset_m {
            0.0 => "at the tip".to_owned(),
            offset if offset > 0.0 => format!("{} beyond the tip", metres(offset)),
            offset => format!("{} short of the tip", metres(-offset)),
        };
        println!("  payload    {} {place}", kilograms(report.payload_mass_kg));
    }
    println!("  hub        {}", hub(report));
    if let Some(inertia) = report.inertia_kgm2 {
        println!("  inertia    {} kg m\u{b2} about the motor axis", digits(inertia));
    }
    if let Some(mass) = report.moved_mass_kg {
        println!("  axis       linear, moves {} with the carriage", kilograms(mass));
    }
    for line in report.deduced.lines() {
        println!("  deduced    {line}");
    }
    println!("  mode       frequency Hz     period ms    damping %  ticks a period");
    for i in 0..report.frequency_hz.len() {
        println!(
            "  {:<9} {:>13} {:>13} {:>12} {:>15}",
            i + 1,
            digits(report.frequency_hz[i]),
            digits(1e3 * report.period_s[i]),
            digits(100.0 * report.damping_ratio[i]),
            digits(report.ticks_per_period[i])
        );
    }
    println!("  sag        {}", sag(report));
    println!("  tick       {}", resolved(report));
    match &report.method {
        Some(method) => print_method(method),
        None => println!("  method     none chosen: the scene has no moves"),
    }
}

fn print_method(method: &MethodReport) {
    println!(
        "  method     {}: expected to err by {} of L and {} of the torque\u{2019}s peak",
        method.name,
        short_percent(method.tip_error, 2),
        short_percent(method.torque_error, 2)
    );
    println!("             {}", method.why);
}

/// Says where the link begins and how stiff its joint is.
fn hub(report: &ArmReport) -> String {
    let joint = match report.hub_stiffness_nm_rad {
        Some(stiffness) => format!("a joint of {} N m/rad", digits(stiffness)),
        None => "a clamp that does not give".to_owned(),
    };
    format!("{} from motor axis to link, {joint}", metres(report.hub_radius_m))
}

/// Says how far the tip sags: held level, and where the scene begins.
fn sag(report: &ArmReport) -> String {
    let of = |sag: Option<f64>| {
        sag.map_or("no stable rest".to_owned(), |sag| {
            format!("{} ({:.2} % of L)", metres(sag), 100.0 * sag / report.length_m)
        })
    };
    match (report.sag_m, report.sag_at_start_m) {
        (Some(level), Some(start)) if level == 0.0 && start == 0.0 => {
            "none: no gravity acts in the plane of motion".to_owned()
        }
        (level, _) if report.axis == "linear" => format!("{} on its carriage", of(level)),
        (level, start) => format!("{} held level, {} at the first angle", of(level), of(start)),
    }
}

/// Says which modes the ticks resolve.
fn resolved(report: &ArmReport) -> String {
    let tick = 1e3 * report.tick_s;
    let most = 0.25 / report.tick_s;
    let modes = match report.resolved_modes {
        0 => "no mode; use a shorter tick".to_owned(),
        1 => "mode 1".to_owned(),
        n if n == report.frequency_hz.len() => format!("modes 1 to {n}, perhaps more"),
        n => format!("modes 1 to {n}"),
    };
    format!(
        "{} ms resolves vibrations up to {} Hz, four ticks a period: {modes}",
        digits(tick),
        digits(most)
    )
}

/// Writes a mass in kg, or in g below one.
fn kilograms(mass: f64) -> String {
    if mass < 1.0 { format!("{} g", digits(1e3 * mass)) } else { format!("{} kg", digits(mass)) }
}

/// Writes a length in m, or in mm below 0.1.
fn metres(length: f64) -> String {
    if length.abs() < 0.1 {
        format!("{} mm", digits(1e3 * length))
    } else {
        format!("{} m", digits(length))
    }
}

/// Writes a number with four significant digits.
fn digits(value: f64) -> String {
    significant(value, 4).to_string()
}

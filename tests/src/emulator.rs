//! Runs images in QEMU, under a time limit.

use std::ffi::OsStr;
use std::io::{ErrorKind, Read};
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

use wait_timeout::ChildExt;

/// Clock of the emulator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clock {
    /// The host's time, the fastest.
    Host,
    /// 1,024 ns an instruction, so that the target can count its instructions.
    Instructions,
}

/// A board that QEMU emulates. The maps of memory and devices of those of Arm are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Board {
    /// Cortex-M4F, with an FPU for single precision.
    An386,
    /// Cortex-M3, without an FPU.
    An385,
    /// RV32IMAC, without an FPU.
    RiscV,
}

impl Board {
    /// QEMU's program, its Debian package, and the arguments that name the machine.
    fn qemu(self) -> (&'static str, &'static str, &'static [&'static str]) {
        match self {
            Self::An386 => ("qemu-system-arm", "qemu-system-arm", &["-M", "mps2-an386"]),
            Self::An385 => ("qemu-system-arm", "qemu-system-arm", &["-M", "mps2-an385"]),
            Self::RiscV => (
                "qemu-system-riscv32",
                "qemu-system-misc",
                &["-M", "virt", "-cpu", "rv32,f=false,d=false", "-bios", "none"],
            ),
        }
    }
}

/// Time limit of a run, for an image that hangs. The longest, of soft floats, takes half a minute
/// on an idle machine; a busy one has taken four times as long.
pub const LIMIT: Duration = Duration::from_secs(600);

/// Runs `image` on the Cortex-M4F and returns what it printed.
///
/// # Errors
/// An error is returned if QEMU is missing, the image fails (with its exit code and messages), or
/// the time is over.
pub fn run(image: &Path, clock: Clock, limit: Duration) -> Result<Vec<u8>, String> {
    run_on(Board::An386, image, clock, limit)
}

/// Runs `image` on a board and returns what it printed.
///
/// # Errors
/// Errors are those of [`run`].
pub fn run_on(
    board: Board,
    image: &Path,
    clock: Clock,
    limit: Duration,
) -> Result<Vec<u8>, String> {
    let arguments: &[&str] = match clock {
        Clock::Host => &[],
        Clock::Instructions => &["-icount", "shift=10,sleep=off"],
    };
    run_with(board, image, arguments.iter().map(OsStr::new), limit)
}

/// Runs `image` on the Cortex-M4F, writes every instruction that it executes to `log`, and returns
/// what it printed. The log takes some 120 bytes an instruction.
///
/// # Errors
/// Errors are those of [`run`].
pub fn trace(image: &Path, log: &Path, limit: Duration) -> Result<Vec<u8>, String> {
    let arguments = ["-singlestep", "-d", "in_asm,exec,nochain", "-D"].map(OsStr::new);
    run_with(Board::An386, image, arguments.into_iter().chain([log.as_os_str()]), limit)
}

fn run_with<'a>(
    board: Board,
    image: &Path,
    arguments: impl Iterator<Item = &'a OsStr>,
    limit: Duration,
) -> Result<Vec<u8>, String> {
    let (program, package, machine) = board.qemu();
    let mut qemu = Command::new(program);
    qemu.args(machine)
        .args(["-nographic", "-monitor", "none", "-serial", "none"])
        .args(["-semihosting-config", "enable=on,target=native"])
        .args(arguments)
        .arg("-kernel")
        .arg(image)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = qemu.spawn().map_err(|error| match error.kind() {
        ErrorKind::NotFound => {
            format!("{program} is missing: run `apt-get install --no-install-recommends {package}`")
        }
        _ => format!("{program}: {error}"),
    })?;
    let printed = collect(child.stdout.take());
    let said = collect(child.stderr.take());
    let waited = child.wait_timeout(limit).map_err(|error| format!("{program}: {error}"))?;
    if waited.is_none() {
        // Closes the pipes too, so that the collectors end.
        let _ = child.kill();
        let _ = child.wait();
    }
    let (printed, said) = (printed.join().unwrap_or_default(), said.join().unwrap_or_default());
    let said = String::from_utf8_lossy(&said);
    match waited {
        Some(status) if status.success() => Ok(printed),
        Some(status) => Err(format!("{} in QEMU: {status}\n{said}", image.display())),
        None => Err(format!(
            "{} in QEMU: no end after {} s, stopped; it had printed {} bytes\n{said}",
            image.display(),
            limit.as_secs(),
            printed.len()
        )),
    }
}

/// Reads a pipe to its end beside the run, because a full pipe would stop the emulator.
fn collect(pipe: Option<impl Read + Send + 'static>) -> thread::JoinHandle<Vec<u8>> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        if let Some(mut pipe) = pipe {
            // A broken pipe shows as missing bytes.
            let _ = pipe.read_to_end(&mut bytes);
        }
        bytes
    })
}

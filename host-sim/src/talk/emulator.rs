//! The firmware in QEMU: two serial lines over TCP, and grants of time on its standard input. Its
//! log goes to the standard output, which is a file, so that a line can be read as soon as it is
//! written.

use std::io::{ErrorKind, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use super::image;
use super::log::Log;
use super::machine::POLL;
use crate::error::Error;

/// Time within which QEMU must connect. It takes a fraction of a second on an idle machine.
const CONNECT: Duration = Duration::from_secs(120);

/// A running QEMU; it ends with this value.
pub struct Emulator {
    child: Child,
    grants: ChildStdin,
    pub(super) bus: TcpStream,
    pub(super) log: Log,
}

impl Emulator {
    /// Starts an image and returns it with its link.
    pub(super) fn start(path: &Path) -> Result<(Self, TcpStream), Error> {
        let elf = std::fs::read(path).map_err(|cause| {
            Error::file(
                path,
                format_args!(
                    "{cause}; must be the application's image: {}; --image FILE if it was built \
                     with --target-dir",
                    image::BUILD
                ),
            )
        })?;
        image::check(path, &elf)?;
        let temporary = |error| Error::new(format_args!("temporary file: {error}"));
        let output = tempfile::NamedTempFile::new().map_err(temporary)?;
        // Opened twice, because the two read and write at places of their own.
        let log = Log::new(&elf, output.reopen().map_err(temporary)?)?;
        let (link, link_address) = listen()?;
        let (bus, bus_address) = listen()?;
        let mut child = Command::new("qemu-system-arm")
            .args(["-M", "mps2-an386", "-nographic", "-monitor", "none"])
            .args(["-serial", &link_address, "-serial", &bus_address])
            .args(["-semihosting-config", "enable=on,target=native"])
            // 64 ns an instruction: the board's file says why.
            .args(["-icount", "shift=6,sleep=off", "-kernel"])
            .arg(path)
            .stdin(Stdio::piped())
            .stdout(output.into_file())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| match error.kind() {
                ErrorKind::NotFound => Error::new(
                    "qemu-system-arm: not found; apt-get install --no-install-recommends \
                     qemu-system-arm",
                ),
                _ => Error::new(format_args!("qemu-system-arm: {error}")),
            })?;
        let grants = child.stdin.take().ok_or_else(|| Error::new("qemu-system-arm: no pipe"))?;
        let link = connect(&link, &mut child)?;
        let bus = connect(&bus, &mut child)?;
        Ok((Self { child, grants, bus, log }, link))
    }

    /// Grants one tick, once `bytes` bytes of link and bus are in, and keeps it from running for
    /// `stall` µs.
    pub(super) fn grant(&mut self, bytes: [u8; 2], stall: u16) -> std::io::Result<()> {
        let ([link, bus], [low, high]) = (bytes, stall.to_le_bytes());
        self.grants.write_all(&[link, bus, low, high])?;
        self.grants.flush()
    }

    /// Returns how QEMU ended, if it did, and its messages.
    pub(super) fn epitaph(&mut self) -> String {
        match self.child.try_wait() {
            Ok(Some(status)) => format!("; QEMU ended, {status}{}", said(&mut self.child)),
            _ => String::new(),
        }
    }
}

impl Drop for Emulator {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn listen() -> Result<(TcpListener, String), Error> {
    let open = || {
        let listener = TcpListener::bind(("127.0.0.1", 0))?;
        listener.set_nonblocking(true)?;
        let port = listener.local_addr()?.port();
        Ok((listener, format!("tcp:127.0.0.1:{port},nodelay=on")))
    };
    open().map_err(|error: std::io::Error| Error::new(format_args!("127.0.0.1: {error}")))
}

fn connect(listener: &TcpListener, child: &mut Child) -> Result<TcpStream, Error> {
    let begin = Instant::now();
    loop {
        match listener.accept() {
            Ok((stream, _)) => {
                let set = stream.set_nonblocking(false).and_then(|()| {
                    stream.set_nodelay(true)?;
                    stream.set_read_timeout(Some(POLL))
                });
                return set.map(|()| stream).map_err(|e| Error::new(format_args!("QEMU: {e}")));
            }
            Err(error) if error.kind() != ErrorKind::WouldBlock => {
                return Err(Error::new(format_args!("QEMU: {error}")));
            }
            Err(_) => {}
        }
        if let Ok(Some(status)) = child.try_wait() {
            return Err(Error::new(format_args!("QEMU ended, {status}{}", said(child))));
        }
        if begin.elapsed() > CONNECT {
            let _ = child.kill();
            let seconds = CONNECT.as_secs();
            return Err(Error::new(format_args!("QEMU: not connected after {seconds} s")));
        }
        thread::sleep(Duration::from_millis(5));
    }
}

/// Returns the standard error of an ended child.
fn said(child: &mut Child) -> String {
    let mut text = String::new();
    if let Some(mut pipe) = child.stderr.take() {
        let _ = pipe.read_to_string(&mut text);
    }
    if text.is_empty() { text } else { format!(": {text}") }
}

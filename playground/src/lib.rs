#![no_std]
#![warn(clippy::too_many_lines)]
//! The core as a WebAssembly module: what the page of `stillbeam-sim playground` calls.
//!
//! The page writes numbers into [`input`], calls [`set_up`], then [`run`] for each motion, and
//! reads [`rows`]. A setpoint is the same to the bit as that of `stillbeam-sim run` for the scene
//! file that the page shows: set-up in f64 and ticks in f32 hold no operation that IEEE 754 leaves
//! open.
//!
//! The module has one page and one thread. Its memory is fixed and it calls nothing of the page's.

mod arm;
mod input;
mod motion;
mod page;
mod residual;
mod setpoints;
mod shape;
mod text;

use stillbeam::material::MATERIALS;

use input::Input;
use motion::Kind;
use page::{Tables, with};
use setpoints::Run;
use text::Text;

/// Returns the address of the numbers that [`set_up`] reads: see [`Input`].
#[unsafe(no_mangle)]
pub extern "C" fn input() -> *const f64 {
    with(|page, _| page.input.as_ptr())
}

/// Returns the address of the numbers that describe the arm after [`set_up`]: see [`arm::Facts`].
#[unsafe(no_mangle)]
pub extern "C" fn facts() -> *const f64 {
    with(|page, _| page.facts.as_ptr())
}

/// Returns the address of the text that the last call has left: UTF-8, of [`text_length`] bytes.
#[unsafe(no_mangle)]
pub extern "C" fn text() -> *const u8 {
    with(|page, _| page.text.as_ptr())
}

/// Returns the bytes of the text that the last call has left.
#[unsafe(no_mangle)]
pub extern "C" fn text_length() -> usize {
    with(|page, _| page.text.len())
}

/// Leaves the name of a material as the text. Returns false if there is none at that index.
#[unsafe(no_mangle)]
pub extern "C" fn material(index: usize) -> bool {
    with(|page, _| {
        let material = MATERIALS.get(index);
        page.text = material.map_or(Text::EMPTY, |material| Text::of(&material.name));
        material.is_some()
    })
}

/// Takes the arm and the move that [`input`] describes, and plans the three motions. Returns false,
/// and leaves the reason as the text, if the arm is refused.
#[unsafe(no_mangle)]
pub extern "C" fn set_up() -> bool {
    with(|page, _| {
        let arm = arm::Arm::new(&Input::of(&page.input));
        if let Ok(arm) = &arm {
            page.facts = arm.facts();
            page.motions = Kind::ALL.map(|kind| kind.plan(arm));
        }
        let (arm, set_up) = match arm {
            Ok(arm) => (Some(arm), Ok(())),
            Err(refusal) => (None, Err(refusal)),
        };
        page.arm = arm;
        page.settle(set_up)
    })
}

/// Runs a motion (0 cubic, 1 shaped, 2 still) on an arm whose frequencies differ by the fraction
/// `error` from the arm's that it is planned for. Returns the number of [`rows`]; 0, and the reason
/// as the text, if motion or bend is refused.
#[unsafe(no_mangle)]
pub extern "C" fn run(kind: usize, error: f64) -> usize {
    with(|page, tables| {
        let run = Run::of(&page.arm, &page.motions, kind, error);
        let count = run.and_then(|run| run.write(&mut tables.rows[kind]));
        page.counted(count)
    })
}

/// Returns the address of a motion's rows, [`setpoints::COLUMNS`] numbers each.
#[unsafe(no_mangle)]
pub extern "C" fn rows(kind: usize) -> *const f64 {
    with(|_, tables| tables.rows[kind].as_ptr().cast())
}

/// Returns the time at which a motion arrives, s; NaN if it was refused.
#[unsafe(no_mangle)]
pub extern "C" fn arrival(kind: usize) -> f64 {
    with(|page, _| match &page.motions[kind] {
        Ok(motion) => motion.arrival(),
        Err(_) => f64::NAN,
    })
}

/// Returns the duration of a motion before it passes a shaper, s; NaN if it was refused.
#[unsafe(no_mangle)]
pub extern "C" fn duration(kind: usize) -> f64 {
    with(|page, _| match &page.motions[kind] {
        Ok(motion) => motion.moves[0].duration(),
        Err(_) => f64::NAN,
    })
}

/// Returns the bending stiffness of the arm whose frequencies differ by the fraction `error`, N m².
#[unsafe(no_mangle)]
pub extern "C" fn stiffness(error: f64) -> f64 {
    with(|page, _| {
        page.arm.as_ref().map_or(f64::NAN, |arm| arm.detuned(error).link.bending_stiffness)
    })
}

/// Returns the vibration that a motion leaves on an arm whose frequencies differ by the fraction
/// `error`, fraction of the arm's length: see [`residual`]. NaN if the motion or the bend is
/// refused. The rows stay.
#[unsafe(no_mangle)]
pub extern "C" fn residual(kind: usize, error: f64) -> f64 {
    with(|page, Tables { scratch, .. }| {
        let residual = Run::of(&page.arm, &page.motions, kind, error).and_then(|run| {
            let count = run.write(scratch)?;
            Ok(run.residual(&scratch[..count]))
        });
        residual.unwrap_or(f64::NAN)
    })
}

/// Computes the centreline of an arm with modal coordinates `first` and `second`, m √kg. Returns
/// the address of [`shape::POINTS`] pairs of x and y in the hub's frame, m.
#[unsafe(no_mangle)]
pub extern "C" fn shape(first: f64, second: f64) -> *const f64 {
    with(|page, _| {
        if let Some(arm) = &page.arm {
            arm.centreline.bend([first, second], &mut page.shape);
        }
        page.shape.as_ptr().cast()
    })
}

/// Ends the module: a panic is a fault of the program, and the page shows that it has stopped.
#[cfg(target_arch = "wasm32")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}

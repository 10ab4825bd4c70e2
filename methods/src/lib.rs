#![no_std]
#![forbid(unsafe_code)]
//! Every method, once, with its name: a firmware picks one by its type and names it on the wire, a
//! host builds the one that it is told, and the tests run them all.

use stillbeam::model::{EightElements, FourElements, Model, OneElement, Rod, TwoElements};
use stillbeam::prepared::Prepared;
use stillbeam::scene::LinkShape;
use stillbeam::stepper::{Elastica, Modal, Newmark, Pointwise, Quality, Rigid};
use stillbeam::{Error, Scene, Stepper};

/// A stepper with its name in the tables.
pub trait Method: 'static {
    /// The type's name, unique; the method's name on the wire.
    const ID: &'static str;
    /// Family: `rigid`, `newmark`, …
    const METHOD: &'static str;
    /// Elements or modes; 0 where there are none.
    const SIZE: u32;
    /// Property that tells methods of one family and size apart: `consistent` or `lumped` mass, …
    const QUALITY: &'static str;
    /// Terms that the method itself leaves out: `no-spin` or nothing.
    const SKIP: &'static str;
    /// Degrees of freedom that the scene needs to have for this method to be the right one:
    /// whether the payload has rotary inertia, where it matters.
    const PAYLOAD_INERTIA: Option<bool>;
    /// The stepper, in the tick's precision on the target.
    type Stepper: Stepper<Scalar = f32> + Prepared;

    /// Builds the stepper. Set-up.
    fn stepper<S: LinkShape>(scene: &Scene<f64, S>, tick: f64) -> Result<Self::Stepper, Error>;

    /// True if this method is meant for the scene.
    fn fits<S: LinkShape>(scene: &Scene<f64, S>) -> bool {
        Self::PAYLOAD_INERTIA.is_none_or(|needed| needed == (scene.payload.inertia > 0.0))
    }
}

/// Takes the methods one by one, each as a type.
pub trait Visitor {
    /// One method.
    fn visit<M: Method>(&mut self);
}

/// The list: `Type: family, size, quality, skip, payload inertia, stepper type, how it is built`.
macro_rules! methods {
    ($($type:ident: $method:literal, $size:literal, $quality:literal, $skip:literal, $inertia:expr,
       $stepper:ty, $build:expr;)*) => {
        $(
            #[doc = concat!("`", $method, "`, size ", $size, ", ", $quality, " ", $skip, ".")]
            #[derive(Debug)]
            pub enum $type {}

            impl Method for $type {
                const ID: &'static str = stringify!($type);
                const METHOD: &'static str = $method;
                const SIZE: u32 = $size;
                const QUALITY: &'static str = $quality;
                const SKIP: &'static str = $skip;
                const PAYLOAD_INERTIA: Option<bool> = $inertia;
                type Stepper = $stepper;

                fn stepper<S: LinkShape>(
                    scene: &Scene<f64, S>,
                    tick: f64,
                ) -> Result<Self::Stepper, Error> {
                    let build: fn(&Scene<f64, S>, f64) -> Result<$stepper, Error> = $build;
                    build(scene, tick)
                }
            }
        )*

        /// Shows the visitor every method, in the order of the list.
        pub fn visit_all(visitor: &mut impl Visitor) {
            $(visitor.visit::<$type>();)*
        }
    };
}

type Consistent<const N: usize, const W: usize> = Newmark<f32, N, W>;
type Lumped<const N: usize> = Newmark<f32, N, N>;

methods! {
    RigidArm: "rigid", 0, "", "", None, Rigid<f32>, |s, h| Rigid::new(&single(s), h);
    Newmark1: "newmark", 1, "consistent", "", None, Consistent<2, 2>,
        |s, h| Newmark::new(&OneElement::consistent(&single(s))?, h);
    Newmark1Nodal: "newmark", 1, "nodal", "", None, Newmark<f32, 2, 2, false>,
        |s, h| Newmark::nodal(&OneElement::consistent(&single(s))?, h);
    Newmark2: "newmark", 2, "consistent", "", None, Consistent<4, 4>,
        |s, h| Newmark::new(&TwoElements::consistent(&single(s))?, h);
    Newmark4: "newmark", 4, "consistent", "", None, Consistent<8, 4>,
        |s, h| Newmark::new(&FourElements::consistent(&single(s))?, h);
    Newmark8: "newmark", 8, "consistent", "", None, Consistent<16, 4>,
        |s, h| Newmark::new(&EightElements::consistent(&single(s))?, h);
    Newmark1NoSpin: "newmark", 1, "consistent", "no-spin", None, Consistent<2, 2>,
        |s, h| Ok(Newmark::new(&OneElement::consistent(&single(s))?, h)?.without_spin());
    Newmark2NoSpin: "newmark", 2, "consistent", "no-spin", None, Consistent<4, 4>,
        |s, h| Ok(Newmark::new(&TwoElements::consistent(&single(s))?, h)?.without_spin());
    Newmark4NoSpin: "newmark", 4, "consistent", "no-spin", None, Consistent<8, 4>,
        |s, h| Ok(Newmark::new(&FourElements::consistent(&single(s))?, h)?.without_spin());
    Newmark8NoSpin: "newmark", 8, "consistent", "no-spin", None, Consistent<16, 4>,
        |s, h| Ok(Newmark::new(&EightElements::consistent(&single(s))?, h)?.without_spin());
    Lumped1: "newmark", 1, "lumped", "", Some(false), Lumped<1>,
        |s, h| Newmark::new(&Model::lumped::<2>(s)?, h);
    Lumped2: "newmark", 2, "lumped", "", Some(false), Lumped<2>,
        |s, h| Newmark::new(&Model::lumped::<4>(s)?, h);
    Lumped4: "newmark", 4, "lumped", "", Some(false), Lumped<4>,
        |s, h| Newmark::new(&Model::lumped::<8>(s)?, h);
    Lumped8: "newmark", 8, "lumped", "", Some(false), Lumped<8>,
        |s, h| Newmark::new(&Model::lumped::<16>(s)?, h);
    // The payload's rotary inertia keeps one more degree of freedom, the tip's rotation.
    Lumped1Tip: "newmark", 1, "lumped", "", Some(true), Lumped<2>,
        |s, h| Newmark::new(&Model::lumped::<2>(s)?, h);
    Lumped2Tip: "newmark", 2, "lumped", "", Some(true), Lumped<3>,
        |s, h| Newmark::new(&Model::lumped::<4>(s)?, h);
    Lumped4Tip: "newmark", 4, "lumped", "", Some(true), Lumped<5>,
        |s, h| Newmark::new(&Model::lumped::<8>(s)?, h);
    Lumped8Tip: "newmark", 8, "lumped", "", Some(true), Lumped<9>,
        |s, h| Newmark::new(&Model::lumped::<16>(s)?, h);
    Modal1: "modal", 1, "", "", None, Modal<f32, 1>,
        |s, h| Modal::new(&EightElements::consistent(s)?, h);
    Modal2: "modal", 2, "", "", None, Modal<f32, 2>,
        |s, h| Modal::new(&EightElements::consistent(s)?, h);
    Modal3: "modal", 3, "", "", None, Modal<f32, 3>,
        |s, h| Modal::new(&EightElements::consistent(s)?, h);
    Modal2NoSpin: "modal", 2, "", "no-spin", None, Modal<f32, 2>,
        |s, h| Ok(Modal::new(&EightElements::consistent(s)?, h)?.without_spin());
    Elastica1: "elastica", 1, "fast", "", None, Elastica<f32, 1>,
        |s, h| Elastica::new(&Rod::new(s)?, h, Quality::Fast, BEND);
    Elastica2: "elastica", 2, "fast", "", None, Elastica<f32, 2>,
        |s, h| Elastica::new(&Rod::new(s)?, h, Quality::Fast, BEND);
    Elastica2Fine: "elastica", 2, "fine", "", None, Elastica<f32, 2>,
        |s, h| Elastica::new(&Rod::new(s)?, h, Quality::Fine, BEND);
    Elastica3Fine: "elastica", 3, "fine", "", None, Elastica<f32, 3>,
        |s, h| Elastica::new(&Rod::new(s)?, h, Quality::Fine, BEND);
    Pointwise3: "pointwise", 3, "", "", None, Pointwise<f32, 3>, |s, h| Pointwise::new(s, h);
}

/// Shows the visitor one method of each kind, in the order of the list: enough for a processor that
/// computes in software, where every method is made of the same few routines.
pub fn visit_some(visitor: &mut impl Visitor) {
    visitor.visit::<RigidArm>();
    visitor.visit::<Newmark1>();
    visitor.visit::<Newmark1Nodal>();
    visitor.visit::<Newmark4>();
    visitor.visit::<Lumped2>();
    visitor.visit::<Modal2>();
    visitor.visit::<Elastica2>();
    visitor.visit::<Elastica2Fine>();
    visitor.visit::<Pointwise3>();
}

/// Shows the visitor one method of each way to step. Soft floats of another processor are proved by
/// them: each is made of the same additions, products, divisions and roots.
pub fn visit_few(visitor: &mut impl Visitor) {
    visitor.visit::<Newmark1>();
    visitor.visit::<Modal2>();
    visitor.visit::<Elastica2>();
    visitor.visit::<Pointwise3>();
}

/// True if the processor that this is compiled for computes floats in hardware.
pub const HAS_FPU: bool = cfg!(any(not(target_os = "none"), target_abi = "eabihf"));

/// Shows the visitor the methods that the processor runs which this is compiled for: every one, or
/// without a floating-point unit one of each kind.
pub fn visit_own(visitor: &mut impl Visitor) {
    if HAS_FPU { visit_all(visitor) } else { visit_some(visitor) }
}

/// In whose precision the consistent models are set up: a tenth of the instructions of f64, and no
/// less exact than a tick in f32 is anyway. Lumped masses and modes take f64.
fn single<S: LinkShape>(scene: &Scene<f64, S>) -> Scene<f32, S> {
    scene.cast()
}

/// Tip angle that elastica is fitted for, rad: enough for every scene of the list and the bench.
const BEND: f64 = 1.5;

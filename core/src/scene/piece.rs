//! Pieces of a link within which stiffness, mass and axial force are smooth.

use super::{Section, Varied};
use crate::math::{GAUSS_POINTS, gauss_points, polynomial};

/// A part of one section without a point mass inside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    section: Section,
    /// Where the section begins, fraction of L.
    begin: f64,
    /// Ends of the piece, fractions of L.
    from: f64,
    to: f64,
}

/// A point of the quadrature over a piece.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    /// Place, fraction of L.
    pub xi: f64,
    /// `w dξ`.
    pub weight: f64,
    /// `EI` and `ρA` there, as multiples of the link's `EI` and `m/L`.
    pub stiffness: f64,
    pub density: f64,
}

impl Piece {
    /// Where the piece ends, fraction of L.
    pub(crate) fn end(&self) -> f64 {
        self.to
    }

    /// Length, fraction of L.
    pub(crate) fn length(&self) -> f64 {
        self.to - self.from
    }

    /// The first part of the piece, `share` of its length.
    pub(crate) fn first(&self, share: f64) -> Self {
        Self { to: self.from + share * self.length(), ..*self }
    }

    /// The points of Gauss's rule over the piece.
    pub(crate) fn points(&self) -> [Point; GAUSS_POINTS] {
        let length = self.length();
        gauss_points().map(|(s, weight)| {
            let xi = self.from + s * length;
            let own = (xi - self.begin) / self.section.length;
            Point {
                xi,
                weight: weight * length,
                stiffness: polynomial(&self.section.stiffness, own),
                density: polynomial(&self.section.density, own),
            }
        })
    }
}

/// Shortest piece, fraction of L: what rounding leaves between two borders is none.
const SHORTEST: f64 = 1e-12;

impl Varied {
    /// Calls `f` with the pieces of the link between two places, fractions of L, in their order.
    pub(crate) fn each_piece(&self, from: f64, to: f64, mut f: impl FnMut(&Piece)) {
        for (begin, section) in self.sections() {
            let (mut at, end) = (from.max(begin), to.min(begin + section.length));
            while end - at > SHORTEST {
                let next = self
                    .masses()
                    .map(|mass| mass.position)
                    .filter(|&position| position - at > SHORTEST)
                    .fold(end, f64::min);
                f(&Piece { section, begin, from: at, to: next });
                at = next;
            }
        }
    }
}

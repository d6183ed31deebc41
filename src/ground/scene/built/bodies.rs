//! Stand-ins for models of the papers that are not available: a Buddha, a bird, a head, an armor and a dolphin,
//! composed of rounded pieces.
//!
//! Models are about 2.5 units high around the origin, with fronts towards -y and a little +x. The Buddha's coat was
//! designed to bring omega close to its small value in Table 1 of the paper on all-frequency transfer, so our omega is
//! not evidence. The other models were shaped by eye.

use super::isosurface::{Folds, RoundedBody, RoundedPiece};
use super::resample::ClosedSurface;
use crate::elementary::on_circle;
use RoundedPiece::{Ball, Drum, Limb, Ring};
use glam::DVec3;

/// Half edge of the cube around every body.
const HALF: f64 = 1.6;
/// Fraction of a full turn by which bodies are rotated towards +x.
const TURNED: f64 = 0.09;

fn turned(body: &RoundedBody, vertices: usize) -> ClosedSurface {
    let mut surface = body.surface(HALF, vertices);
    let [cos, sin] = on_circle(TURNED);
    for at in &mut surface.positions {
        *at = DVec3::new(cos * at.x - sin * at.y, sin * at.x + cos * at.y, at.z);
    }
    surface
}

/// A standing Buddha in a folded coat, with both arms above his head, on a pedestal of petals.
pub(super) fn buddha(vertices: usize) -> ClosedSurface {
    let mut body = RoundedBody::default();
    // A folded coat that is open in front, and the legs in it.
    body.add(Limb([0.0, 0.06, -0.95], [0.0, 0.04, 0.4], [0.54, 0.36]), 0.0);
    body.fold(Folds { count: 17.0, depth: 0.035, twist: 0.0, heights: [-1.4, 0.6] });
    body.carve(Limb([0.0, -0.16, -1.1], [0.0, -0.12, 0.4], [0.48, 0.3]), 0.03);
    body.add_both(Limb([0.17, 0.0, -0.95], [0.15, 0.0, 0.0], [0.15, 0.2]), 0.02);
    body.add(Ball([0.0, -0.12, 0.1], [0.4, 0.36, 0.34]), 0.08);
    body.add(Ball([0.0, 0.02, 0.4], [0.36, 0.26, 0.3]), 0.12);
    body.add_both(Ball([0.15, -0.19, 0.42], [0.14, 0.1, 0.12]), 0.04);
    body.carve(Ball([0.0, -0.49, 0.08], [0.03, 0.04, 0.03]), 0.02);
    // Arms in wide sleeves.
    body.add_both(Limb([0.34, 0.03, 0.58], [0.62, -0.04, 0.72], [0.14, 0.14]), 0.06);
    body.add_both(Limb([0.6, 0.0, 0.68], [0.66, 0.06, 0.16], [0.13, 0.22]), 0.04);
    body.carve_both(Limb([0.64, 0.04, 0.4], [0.68, 0.06, -0.2], [0.05, 0.21]), 0.02);
    body.add_both(Limb([0.62, -0.04, 0.74], [0.4, -0.08, 1.08], [0.1, 0.07]), 0.03);
    body.add(Ring([0.0, -0.1, 0.5], [0.26, 0.05]), 0.02);
    // Head.
    body.add(Limb([0.0, 0.0, 0.6], [0.0, -0.02, 0.78], [0.13, 0.12]), 0.06);
    body.add(Ball([0.0, -0.03, 0.88], [0.19, 0.2, 0.22]), 0.03);
    body.add(Ball([0.0, -0.08, 0.78], [0.17, 0.14, 0.12]), 0.05);
    body.add_both(Ball([0.195, 0.0, 0.83], [0.035, 0.06, 0.13]), 0.02);
    body.add(Ball([0.0, 0.01, 1.09], [0.1, 0.1, 0.09]), 0.03);
    body.add(Limb([0.0, -0.215, 0.92], [0.0, -0.24, 0.84], [0.02, 0.035]), 0.02);
    body.carve_both(Ball([0.08, -0.21, 0.915], [0.05, 0.05, 0.025]), 0.02);
    body.carve(Ball([0.0, -0.235, 0.765], [0.07, 0.05, 0.014]), 0.015);
    // Objects in the raised hands.
    body.add_both(Ball([0.38, -0.08, 1.13], [0.08, 0.07, 0.08]), 0.02);
    body.add(Ball([0.0, -0.08, 1.27], [0.42, 0.17, 0.07]), 0.02);
    body.add_both(Ball([0.36, -0.08, 1.31], [0.1, 0.12, 0.09]), 0.03);
    // Feet and pedestal.
    body.add_both(Ball([0.16, -0.2, -0.98], [0.09, 0.17, 0.06]), 0.03);
    body.add(Drum([0.0, 0.0, -1.09], [0.48, 0.08, 0.03]), 0.02);
    for petal in 0..12 {
        let [x, y] = on_circle(f64::from(petal) / 12.0);
        body.add(Ball([0.5 * x, 0.5 * y, -1.1], [0.11, 0.11, 0.1]), 0.01);
    }
    body.add(Drum([0.0, 0.0, -1.2], [0.6, 0.06, 0.03]), 0.02);
    body.carve(Drum([0.0, 0.0, -1.75], [1.0, 0.5, 0.02]), 0.0);
    turned(&body, vertices)
}

/// A smooth bird, as in the paper (section 7, Figure 11), with folded wings, tail, crest, legs and toes.
pub(super) fn bird(vertices: usize) -> ClosedSurface {
    let mut body = RoundedBody::default();
    body.add(Ball([0.0, 0.1, -0.15], [0.52, 0.66, 0.58]), 0.0);
    body.add(Ball([0.0, -0.12, 0.02], [0.46, 0.5, 0.55]), 0.2);
    body.add(Ball([0.0, -0.42, 0.68], [0.38, 0.4, 0.38]), 0.18);
    // Beak and eyes.
    body.add(Limb([0.0, -0.76, 0.66], [0.0, -1.08, 0.54], [0.12, 0.025]), 0.03);
    body.add(Limb([0.0, -0.74, 0.54], [0.0, -0.98, 0.46], [0.09, 0.025]), 0.02);
    body.add_both(Ball([0.24, -0.68, 0.79], [0.09, 0.09, 0.09]), 0.01);
    // Crest.
    for (back, height) in [(-0.5, 1.22), (-0.34, 1.25), (-0.16, 1.18)] {
        body.add(Limb([0.0, -0.4, 0.98], [0.0, back, height], [0.07, 0.025]), 0.03);
    }
    // Wings: a shoulder, and overlapping feathers.
    body.add_both(Ball([0.46, 0.0, 0.08], [0.13, 0.34, 0.27]), 0.04);
    for (feather, low) in [(0.0, 0.02), (1.0, -0.14), (2.0, -0.3), (3.0, -0.44)] {
        let back = 0.86 - 0.12 * feather;
        let out = 0.53 - 0.02 * feather;
        body.add_both(
            Limb([out, -0.12 + 0.05 * feather, low + 0.12], [out - 0.12, back, low - 0.16], [0.09, 0.06]),
            0.02,
        );
    }
    // Tail.
    for aside in [0.0, 0.14, 0.27] {
        body.add_both(Limb([0.4 * aside, 0.6, -0.3], [aside, 1.3, -0.52 + 0.2 * aside], [0.09, 0.06]), 0.02);
    }
    // Legs and toes.
    body.add_both(Limb([0.2, 0.0, -0.6], [0.22, -0.04, -0.86], [0.14, 0.06]), 0.06);
    body.add_both(Limb([0.22, -0.04, -0.86], [0.22, -0.06, -1.16], [0.055, 0.055]), 0.02);
    for toe in [[0.1, -0.36], [0.24, -0.4], [0.38, -0.34], [0.23, 0.18]] {
        body.add_both(Limb([0.22, -0.06, -1.17], [toe[0], toe[1], -1.2], [0.055, 0.035]), 0.02);
    }
    turned(&body, vertices)
}

/// A head on its neck and shoulders.
pub(super) fn head(vertices: usize) -> ClosedSurface {
    let mut body = RoundedBody::default();
    body.add(Ball([0.0, 0.12, 0.42], [0.56, 0.68, 0.68]), 0.0);
    body.add(Ball([0.0, -0.14, 0.0], [0.43, 0.5, 0.5]), 0.2);
    body.add(Ball([0.0, -0.32, -0.26], [0.26, 0.26, 0.2]), 0.15);
    body.add(Limb([0.0, 0.15, -0.3], [0.0, 0.22, -1.0], [0.34, 0.38]), 0.12);
    body.add(Ball([0.0, 0.25, -1.12], [0.86, 0.42, 0.22]), 0.2);
    // Brows, eyes, nose, mouth, chin, ears.
    body.carve_both(Ball([0.23, -0.62, 0.22], [0.15, 0.12, 0.1]), 0.1);
    body.add_both(Limb([0.08, -0.53, 0.38], [0.4, -0.38, 0.36], [0.07, 0.06]), 0.1);
    body.add_both(Ball([0.21, -0.48, 0.21], [0.1, 0.09, 0.085]), 0.01);
    body.add_both(Ball([0.33, -0.4, -0.02], [0.12, 0.12, 0.11]), 0.12);
    body.add(Limb([0.0, -0.6, 0.3], [0.0, -0.8, -0.02], [0.05, 0.085]), 0.06);
    body.add_both(Ball([0.075, -0.72, -0.04], [0.06, 0.08, 0.05]), 0.03);
    body.add(Ball([0.0, -0.585, -0.2], [0.17, 0.07, 0.045]), 0.04);
    body.add(Ball([0.0, -0.57, -0.28], [0.15, 0.07, 0.05]), 0.03);
    body.carve(Ball([0.0, -0.66, -0.238], [0.15, 0.06, 0.012]), 0.02);
    body.add(Ball([0.0, -0.5, -0.45], [0.14, 0.13, 0.1]), 0.08);
    body.add_both(Ball([0.53, 0.1, 0.2], [0.07, 0.15, 0.2]), 0.06);
    body.carve_both(Ball([0.63, 0.06, 0.2], [0.05, 0.08, 0.12]), 0.02);
    turned(&body, vertices)
}

/// A suit of armor from helmet to skirt.
pub(super) fn armor(vertices: usize) -> ClosedSurface {
    let mut body = RoundedBody::default();
    body.add(Ball([0.0, 0.0, 0.25], [0.52, 0.36, 0.62]), 0.0);
    body.add(Limb([0.0, 0.0, -0.35], [0.0, 0.0, -1.0], [0.38, 0.56]), 0.08);
    body.fold(Folds { count: 14.0, depth: 0.05, twist: 0.0, heights: [-1.6, -0.2] });
    body.add(Ring([0.0, 0.0, -0.3], [0.38, 0.06]), 0.02);
    body.add(Limb([0.0, -0.3, -0.15], [0.0, -0.36, 0.55], [0.05, 0.05]), 0.08);
    for plate in [0.0, 1.0, 2.0] {
        let place = [0.62 + 0.05 * plate, 0.0, 0.66 - 0.13 * plate];
        body.add_both(Ball(place, [0.28 - 0.02 * plate, 0.3, 0.15]), 0.01);
    }
    body.add_both(Limb([0.72, 0.0, 0.4], [0.8, -0.02, -0.02], [0.16, 0.13]), 0.02);
    body.add_both(Ball([0.8, -0.02, -0.06], [0.17, 0.17, 0.13]), 0.01);
    body.add_both(Limb([0.8, -0.04, -0.1], [0.84, -0.16, -0.52], [0.13, 0.11]), 0.02);
    body.add_both(Ball([0.85, -0.2, -0.62], [0.12, 0.13, 0.15]), 0.02);
    body.add(Limb([0.0, 0.0, 0.7], [0.0, 0.0, 1.0], [0.24, 0.18]), 0.0);
    body.add(Ring([0.0, 0.0, 0.84], [0.24, 0.07]), 0.02);
    body.add(Ball([0.0, 0.0, 1.08], [0.24, 0.28, 0.3]), 0.02);
    body.carve_both(Ball([0.11, -0.25, 1.14], [0.085, 0.07, 0.022]), 0.01);
    body.add(Limb([0.0, -0.27, 0.9], [0.0, -0.3, 1.16], [0.03, 0.03]), 0.05);
    body.add(Limb([0.0, -0.2, 1.3], [0.0, 0.22, 1.28], [0.05, 0.05]), 0.03);
    turned(&body, vertices)
}

/// A dolphin along x, its snout towards +x, with fins.
pub(super) fn dolphin(vertices: usize) -> ClosedSurface {
    let mut body = RoundedBody::default();
    let spine = [(-1.15, 0.1, 0.05), (-0.75, 0.03, 0.12), (-0.15, 0.0, 0.27), (0.4, 0.02, 0.28), (0.8, -0.02, 0.2)];
    for ends in spine.windows(2) {
        let [(from, low, thin), (to, high, thick)] = [ends[0], ends[1]];
        body.add(Limb([0.0, from, low], [0.0, to, high], [thin, thick]), 0.02);
    }
    body.add(Limb([0.0, 0.95, -0.06], [0.0, 1.3, -0.12], [0.09, 0.045]), 0.06);
    body.add(Limb([0.0, 0.0, 0.22], [0.0, -0.2, 0.46], [0.06, 0.02]), 0.08);
    body.add(Limb([0.0, -0.12, 0.22], [0.0, -0.2, 0.44], [0.05, 0.02]), 0.08);
    body.add_both(Limb([0.2, 0.4, -0.14], [0.52, 0.16, -0.3], [0.06, 0.025]), 0.05);
    body.add_both(Ball([0.17, -1.24, 0.1], [0.27, 0.12, 0.04]), 0.06);
    body.carve(Limb([0.0, 0.98, -0.1], [0.0, 1.4, -0.15], [0.012, 0.012]), 0.01);
    let mut surface = body.surface(HALF, vertices);
    surface.positions.iter_mut().for_each(|at| *at = 1.5 * DVec3::new(at.y, -at.x, at.z));
    surface
}

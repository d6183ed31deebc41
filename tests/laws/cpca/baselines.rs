//! Baselines of compressed transfer: methods that are equal in exact arithmetic agree.

use crossbar::cpca::baselines::{ExitCoefficients, UncompressedTransfer, ViewMap};
use crossbar::cpca::transfer::{Bounces, Incident, Response, TracedRays, Transfer};
use crossbar::linalg::dot;
use crossbar::sphere::{DirectionRule, HarmonicLight, ParabolicMap};
use crossbar::tracer::HostTracer;
use crossbar::transfer::brdf::{BRDF_DEGREE, Brdf, ExitBasis, brdf_matrix};
use crossbar::transfer::clustering::{Clustering, CpcaForm, CpcaMethod, CpcaOptions, StartPoints, compress};
use crossbar::transfer::synthetic::hills;
use crossbar::transfer::{Signal, Tangents, Vertices};
use glam::DVec3;

const EYE: DVec3 = DVec3::new(1.0, -2.5, 3.0);
const WARD: Brdf = Brdf::Ward { albedo: 0.2, specular: 0.4, roughness: [0.4, 0.7] };

struct Hills {
    vertices: Vertices,
    rays: TracedRays,
    light: HarmonicLight,
}

impl Hills {
    fn new() -> Self {
        let mesh = hills(6);
        let vertices = Vertices::new(&mesh, Tangents::Along(DVec3::X)).expect("vertices");
        let mut tracer = HostTracer::new(&mesh, crossbar::geom::Sides::Both);
        let rays = TracedRays::trace(&vertices, DirectionRule::hemisphere(16), &mut tracer, false).expect("rays");
        Self { vertices, rays, light: HarmonicLight::red_and_blue(5) }
    }

    fn signal(&self, response: Response) -> Signal {
        let transfer = Transfer::new(&self.vertices, &self.rays, &[response], 5, Bounces::Count(0)).expect("transfer");
        Signal::new(transfer.row_count() * 25, transfer.into_values()).expect("a signal")
    }

    /// Transfer matrices by equation 1; without `inverses` the incident light is projected by integrals alone.
    fn glossy(&self, brdf: &Brdf, exit: &ExitBasis, inverses: bool) -> Signal {
        let incident = Incident::Harmonics { order: 5, inverse: inverses };
        let views = DirectionRule::hemisphere(BRDF_DEGREE);
        self.signal(Response::glossy(brdf, exit, inverses, incident, self.rays.rule(), &views).expect("a response"))
    }

    fn exit(&self, signal: &Signal, rows: usize) -> ExitCoefficients {
        UncompressedTransfer::new(signal, rows).expect("matrices").times(&self.light).expect("light of order 5")
    }

    /// Radiance by evaluating the basis functions exactly in f64.
    fn exact(&self, basis: &ExitBasis, exit: &ExitCoefficients) -> Vec<[f64; 3]> {
        let radiance = |vertex: usize| {
            let mut y = vec![0.0; basis.len()];
            basis.values(self.view(vertex), &mut y);
            [0, 1, 2].map(|channel| y.iter().zip(exit.of(vertex)).map(|(y, e)| y * f64::from(e[channel])).sum())
        };
        (0..self.vertices.len()).map(radiance).collect()
    }

    /// The view direction in a vertex's local frame.
    fn view(&self, vertex: usize) -> DVec3 {
        let place = DVec3::from(self.vertices.positions()[vertex].map(f64::from));
        self.vertices.frames()[vertex].to_local((EYE - place).normalize())
    }
}

/// The largest difference, relative to the largest expected number.
fn apart(found: impl IntoIterator<Item = f64>, expected: impl IntoIterator<Item = f64>) -> f64 {
    let pairs: Vec<(f64, f64)> = found.into_iter().zip(expected).collect();
    assert!(!pairs.is_empty());
    let largest = pairs.iter().fold(0.0_f64, |most, (_, expected)| most.max(expected.abs()));
    pairs.iter().fold(0.0_f64, |most, (found, expected)| most.max((found - expected).abs())) / largest
}

/// Exit coefficients as in section 6: products with mean and vectors once per cluster, weighted sums per vertex, in
/// f64.
fn weighted(clustering: &Clustering, rows: usize, light: &HarmonicLight) -> Vec<f64> {
    let product = |part: &[f64]| -> Vec<f64> {
        let of_row = |row: &[f64]| light.channels().each_ref().map(|channel| dot(row, channel));
        part.chunks(part.len() / rows).flat_map(of_row).collect()
    };
    let of_point = |point: usize| {
        let subspace = &clustering.subspaces()[clustering.of_point()[point] as usize];
        let mut sum = product(&subspace.mean);
        for (vector, weight) in subspace.vectors().zip(clustering.weights(point)) {
            sum.iter_mut().zip(product(vector)).for_each(|(sum, value)| *sum += weight * value);
        }
        sum
    };
    (0..clustering.points()).flat_map(of_point).collect()
}

fn flat(exit: &ExitCoefficients) -> Vec<f64> {
    (0..exit.vertex_count()).flat_map(|vertex| exit.of(vertex)).flatten().map(|&value| f64::from(value)).collect()
}

fn options(clusters: usize, vectors: usize) -> CpcaOptions {
    CpcaOptions {
        clusters,
        vectors,
        vq_iterations: 3,
        iterations: 3,
        method: CpcaMethod::Static,
        form: CpcaForm::Affine,
        start: StartPoints::Seed(1),
    }
}

/// Matrices of 25 x 25, 24 x 25 and 16 x 25 of a diffuse surface by equation 1 give the radiance of diffuse transfer.
#[test]
fn matrices_of_every_height_agree_on_lambert() {
    let hills = Hills::new();
    let diffuse = hills.signal(Response::diffuse(0.8, hills.rays.rule()).expect("a response"));
    let expected = flat(&hills.exit(&diffuse, 1));
    for basis in [ExitBasis::of_order(5), ExitBasis::without_1_0(5).expect("24"), ExitBasis::of_order(4)] {
        let signal = hills.glossy(&Brdf::Lambert { albedo: 0.8 }, &basis, true);
        let map = ViewMap::of_basis(&basis, ParabolicMap::new(32));
        let radiance = map.radiance(&hills.vertices, &hills.exit(&signal, basis.len()), EYE).expect("radiance");
        let off = apart(radiance.iter().flatten().map(|&value| f64::from(value)), expected.iter().copied());
        assert!(off < 2e-6, "{} rows: {off:e}", basis.len());
    }
}

/// With as many vectors as dimensions (n' = n) the approximation is exact.
#[test]
fn all_vectors_are_the_uncompressed_transfer() {
    let hills = Hills::new();
    for (basis, clusters) in [(ExitBasis::of_order(5), 1), (ExitBasis::without_1_0(5).expect("24"), 4)] {
        let signal = hills.glossy(&WARD, &basis, true);
        let compressed = compress(&signal, &options(clusters, signal.dimension()), |_| ()).expect("compressed");
        let found = weighted(&compressed.clustering, basis.len(), &hills.light);
        let off = apart(flat(&hills.exit(&signal, basis.len())), found);
        assert!(off < 1e-6, "{clusters} clusters: {off:e}");
    }
}

/// Vector quantisation with one cluster per vertex gives the same bits as no compression.
#[test]
fn a_cluster_per_vertex_is_the_uncompressed_transfer() {
    let hills = Hills::new();
    let signal = hills.glossy(&WARD, &ExitBasis::of_order(4), true);
    let quantised = compress(&signal, &options(signal.points(), 0), |_| ()).expect("compressed").clustering;
    let mut values = Vec::new();
    for point in 0..signal.points() {
        let mut matrix = vec![0.0; signal.dimension()];
        quantised.approximation(point, &mut matrix);
        values.extend(matrix.iter().map(|&value| value as f32));
    }
    let again = Signal::new(signal.dimension(), values).expect("a signal");
    assert_eq!(hills.exit(&again, 16), hills.exit(&signal, 16));
    let fewer = compress(&signal, &options(signal.points() / 2, 0), |_| ()).expect("compressed").clustering;
    assert!(fewer.squared_error(&signal) > 0.0, "half as many are not enough");
}

/// Kautz, Sloan and Snyder's maps of y B times R_p T_p l, and y times M_p l with M_p = B R_p T_p, give the same
/// radiance up to the maps' filter, whose error falls with the square of a texel.
#[test]
fn maps_of_y_b_tend_to_the_matrices() {
    let (hills, basis) = (Hills::new(), ExitBasis::of_order(5));
    let exit = hills.exit(&hills.glossy(&WARD, &basis, false), 25);
    let incident = Transfer::incident(&hills.vertices, &hills.rays, (&basis, false), 5, None).expect("R_p T_p");
    let incident = hills.exit(&Signal::new(625, incident.into_values()).expect("a signal"), 25);
    let brdf = brdf_matrix(&WARD, &basis, 5, &DirectionRule::hemisphere(BRDF_DEGREE)).expect("B");
    // Vertices that face the eye: maps end at the horizon.
    let seen: Vec<usize> = (0..hills.vertices.len()).filter(|&vertex| hills.view(vertex).z > 0.0).collect();
    assert!(seen.len() > 30, "{} vertices", seen.len());
    let expected = hills.exact(&basis, &exit);
    let off = |side: usize| {
        let map = ParabolicMap::new(side);
        let of = |map: &ViewMap, coefficients| {
            let found = map.radiance(&hills.vertices, coefficients, EYE).expect("radiance");
            let pick = |vertex: &usize| found[*vertex].map(f64::from);
            apart(seen.iter().flat_map(pick), seen.iter().flat_map(|&vertex| expected[vertex]))
        };
        let brdf_map = ViewMap::of_brdf(&basis, &brdf, map).expect("rows as in B");
        [of(&brdf_map, &incident), of(&ViewMap::of_basis(&basis, map), &exit)]
    };
    let errors = [16, 32, 64, 128].map(off);
    for pair in errors.windows(2) {
        for (finer, coarser) in pair[1].iter().zip(pair[0]) {
            assert!(*finer < coarser / 2.5, "{errors:?}");
        }
    }
    assert!(errors[3].iter().all(|&error| error < 1e-3), "{errors:?}");
}

#[test]
fn parts_that_do_not_go_together_are_refused() {
    let (hills, basis) = (Hills::new(), ExitBasis::of_order(5));
    let exit = hills.exit(&hills.signal(Response::diffuse(0.5, hills.rays.rule()).expect("a response")), 1);
    let map = ParabolicMap::new(4);
    let radiance = ViewMap::of_basis(&basis, map).radiance(&hills.vertices, &exit, EYE);
    assert_eq!(radiance.unwrap_err().to_string(), "expected 25 coefficients per vertex, one per map, found 1");
    let other = Vertices::new(&crossbar::transfer::synthetic::hills(2), Tangents::Any).expect("vertices");
    let radiance = ViewMap::of_basis(&ExitBasis::Radiance, map).radiance(&other, &exit, EYE);
    assert_eq!(radiance.unwrap_err().to_string(), "expected coefficients of 9 vertices, found those of 49");
    let brdf = brdf_matrix(&WARD, &basis, 5, &DirectionRule::hemisphere(8)).expect("B");
    let refused = ViewMap::of_brdf(&ExitBasis::of_order(4), &brdf, map);
    assert_eq!(
        refused.unwrap_err().to_string(),
        "expected a matrix of 16 rows, one per function of exit radiance, found 25"
    );
}

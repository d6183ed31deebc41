//! Exact first hits, and the comparison of other hits with them.

use crossbar::geom::{Hit, Mesh, Ray, Sides};
use crossbar::oracle::{self as library, Aim, Disagreement, DisagreementKind, JudgedRay, Tolerance};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::error::value_error;
use crate::signals::fill;

/// Rays per parallel task, and number of tasks that run together.
const TASKS: (usize, usize) = (256, 64);

/// Names of the kinds of verdicts, in the order of their codes; code 0 is a right answer.
#[pyfunction]
pub(crate) fn kinds() -> Vec<&'static str> {
    ["right"].into_iter().chain(DisagreementKind::ALL.map(DisagreementKind::name)).collect()
}

/// Names of the aims of rays, in the order of their codes; code 0 is an unknown aim.
#[pyfunction]
pub(crate) fn aims() -> Vec<&'static str> {
    ["unknown"].into_iter().chain(Aim::ALL.map(Aim::name)).collect()
}

fn kind_code(kind: DisagreementKind) -> u8 {
    1 + DisagreementKind::ALL.iter().position(|known| *known == kind).unwrap_or_default() as u8
}

fn aim_code(aim: Option<Aim>) -> u8 {
    aim.and_then(|aim| Aim::ALL.iter().position(|known| *known == aim)).map_or(0, |place| 1 + place as u8)
}

fn triples<'a, T: numpy::Element>(what: &str, array: &'a PyReadonlyArray2<'_, T>) -> PyResult<&'a [[T; 3]]> {
    let shape = array.as_array().shape().to_vec();
    match (array.as_slice(), shape[1]) {
        (Ok(all), 3) => Ok(all.as_chunks().0),
        _ => Err(value_error(format!("expected {what} of shape (n, 3), found {shape:?}"))),
    }
}

fn sides(name: &str) -> PyResult<Sides> {
    match name {
        "both" => Ok(Sides::Both),
        "front" => Ok(Sides::Front),
        other => Err(value_error(format!("expected sides \"both\" or \"front\", found \"{other}\""))),
    }
}

fn mesh(vertices: &PyReadonlyArray2<'_, f32>, faces: &PyReadonlyArray2<'_, u32>) -> PyResult<Mesh> {
    let (vertices, faces) = (triples("vertices", vertices)?, triples("faces", faces)?);
    Mesh::new(vertices.to_vec(), faces.to_vec()).map_err(|error| value_error(error.to_string()))
}

/// Rays as two arrays, which are read without a copy.
struct RayRows<'a> {
    origins: &'a [[f32; 3]],
    directions: &'a [[f32; 3]],
}

impl<'a> RayRows<'a> {
    fn new(origins: &'a PyReadonlyArray2<'_, f32>, directions: &'a PyReadonlyArray2<'_, f32>) -> PyResult<Self> {
        let (origins, directions) = (triples("origins", origins)?, triples("directions", directions)?);
        if origins.len() != directions.len() {
            let (origins, directions) = (origins.len(), directions.len());
            return Err(value_error(format!("expected a direction for each origin, found {origins} and {directions}")));
        }
        let rows = Self { origins, directions };
        for place in 0..origins.len() {
            Ray::new(origins[place], directions[place])
                .map_err(|error| value_error(format!("ray {place}: {error}")))?;
        }
        Ok(rows)
    }

    /// A ray; `None` after the last ray.
    fn get(&self, place: usize) -> Option<Ray> {
        // Every ray was accepted by `new`.
        Ray::new(*self.origins.get(place)?, *self.directions.get(place)?).ok()
    }
}

/// A ray with its aim, if known.
struct Aimed {
    ray: Ray,
    aim: Option<Aim>,
}

impl AsRef<Ray> for Aimed {
    fn as_ref(&self) -> &Ray {
        &self.ray
    }
}

impl JudgedRay for Aimed {
    fn aim(&self) -> Option<Aim> {
        self.aim
    }
}

/// Hits of the code under test, one per ray.
struct FoundHits<'a> {
    rays: RayRows<'a>,
    triangles: &'a [i64],
    ts: &'a [f32],
    aims: &'a [u8],
}

impl<'a> FoundHits<'a> {
    fn new(
        rays: RayRows<'a>,
        triangles: &'a PyReadonlyArray1<'_, i64>,
        ts: &'a PyReadonlyArray1<'_, f32>,
        aims: &'a PyReadonlyArray1<'_, u8>,
    ) -> PyResult<Self> {
        let contiguous = "expected arrays in the order of C";
        let triangles = triangles.as_slice().map_err(|_| value_error(contiguous))?;
        let ts = ts.as_slice().map_err(|_| value_error(contiguous))?;
        let aims = aims.as_slice().map_err(|_| value_error(contiguous))?;
        let count = rays.origins.len();
        for (what, found) in [("triangle", triangles.len()), ("t", ts.len())] {
            if found != count {
                return Err(value_error(format!("expected a {what} for each of {count} rays, found {found}")));
            }
        }
        if !aims.is_empty() && aims.len() != count {
            return Err(value_error(format!("expected an aim for each of {count} rays, found {}", aims.len())));
        }
        Ok(Self { rays, triangles, ts, aims })
    }

    fn ray(&self, place: usize) -> Option<Aimed> {
        let aim = self.aims.get(place).and_then(|&code| Aim::ALL.get(usize::from(code).checked_sub(1)?)).copied();
        Some(Aimed { ray: self.rays.get(place)?, aim })
    }

    /// The hit; a negative id is a miss, and an id beyond the mesh is an unknown triangle.
    fn hit(&self, place: usize) -> Option<Hit> {
        let triangle = *self.triangles.get(place)?;
        let t = *self.ts.get(place)?;
        (triangle >= 0).then(|| Hit { triangle: u32::try_from(triangle).unwrap_or(u32::MAX), t })
    }
}

/// Verdict on a ray, as plain numbers.
#[derive(Clone, Copy, Default)]
struct Verdict {
    kind: u8,
    rounding: bool,
    triangle: i32,
    ties: u32,
    t: f64,
    ulps: i64,
}

type Column<'py, T> = Bound<'py, PyArray1<T>>;
type Hits<'py> = (Column<'py, i32>, Column<'py, u32>, Column<'py, f64>);
type Verdicts<'py> = (Column<'py, u8>, Column<'py, u8>, Column<'py, bool>, Hits<'py>, Column<'py, i64>);

fn column<'py, T: numpy::Element>(py: Python<'py>, verdicts: &[Verdict], of: impl Fn(&Verdict) -> T) -> Column<'py, T> {
    verdicts.iter().map(of).collect::<Vec<T>>().into_pyarray(py)
}

fn hit_columns<'py>(py: Python<'py>, verdicts: &[Verdict]) -> Hits<'py> {
    (column(py, verdicts, |v| v.triangle), column(py, verdicts, |v| v.ties), column(py, verdicts, |v| v.t))
}

/// A mesh for exact hits.
#[pyclass(frozen, module = "crossbar_gi._native")]
pub(crate) struct Oracle {
    oracle: library::Oracle<'static>,
}

#[pymethods]
impl Oracle {
    #[new]
    fn new(
        vertices: PyReadonlyArray2<'_, f32>,
        faces: PyReadonlyArray2<'_, u32>,
        sides_hit: &str,
        tolerance: (u32, f64),
        nearby_ulps: u32,
    ) -> PyResult<Self> {
        let (mesh, (ulps, absolute)) = (mesh(&vertices, &faces)?, tolerance);
        if !(absolute >= 0.0 && absolute.is_finite()) {
            return Err(value_error(format!("expected an absolute tolerance of 0 or more, found {absolute}")));
        }
        let tolerance = Tolerance::ulps(ulps).or_absolute(absolute);
        let oracle = library::Oracle::owning(mesh, sides(sides_hit)?, tolerance).with_nearby_ulps(nearby_ulps);
        Ok(Self { oracle })
    }

    /// Triangle, number of triangles at the same t, and t, for the exact first hit of each ray.
    fn first_hits<'py>(
        &self,
        py: Python<'py>,
        origins: PyReadonlyArray2<'py, f32>,
        directions: PyReadonlyArray2<'py, f32>,
    ) -> PyResult<Hits<'py>> {
        let rays = RayRows::new(&origins, &directions)?;
        let mut verdicts = vec![Verdict::default(); rays.origins.len()];
        fill(
            py,
            &mut verdicts,
            TASKS,
            || (),
            |(), start, out| {
                for (place, out) in (start..).zip(out) {
                    let nearest = rays.get(place).and_then(|ray| self.oracle.first_hit(&ray));
                    *out = verdict(nearest.as_ref(), None);
                }
            },
        )?;
        Ok(hit_columns(py, &verdicts))
    }

    /// Kind, aim, rounding, exact hit and error of t in ULPs, for each ray.
    fn judge<'py>(
        &self,
        py: Python<'py>,
        rays: (PyReadonlyArray2<'py, f32>, PyReadonlyArray2<'py, f32>),
        triangles: PyReadonlyArray1<'py, i64>,
        ts: PyReadonlyArray1<'py, f32>,
        aims: PyReadonlyArray1<'py, u8>,
    ) -> PyResult<Verdicts<'py>> {
        let found = FoundHits::new(RayRows::new(&rays.0, &rays.1)?, &triangles, &ts, &aims)?;
        let mut verdicts = vec![Verdict::default(); found.ts.len()];
        fill(
            py,
            &mut verdicts,
            TASKS,
            || (),
            |(), start, out| {
                for (place, out) in (start..).zip(out) {
                    let Some(ray) = found.ray(place) else { continue };
                    let hit = found.hit(place);
                    let (nearest, wrong) = self.oracle.judge_one(place, &ray, hit);
                    *out = verdict(nearest.as_ref(), wrong.as_ref());
                    out.ulps = t_ulps(nearest.as_ref(), hit);
                }
            },
        )?;
        let aims = (0..verdicts.len()).map(|place| aim_code(found.ray(place).and_then(|ray| ray.aim)));
        let aims = aims.collect::<Vec<u8>>().into_pyarray(py);
        let (kinds, rounding) = (column(py, &verdicts, |v| v.kind), column(py, &verdicts, |v| v.rounding));
        Ok((kinds, aims, rounding, hit_columns(py, &verdicts), column(py, &verdicts, |v| v.ulps)))
    }

    /// The report as text: counts, and the ten worst rays as source code.
    fn report(
        &self,
        py: Python<'_>,
        rays: (PyReadonlyArray2<'_, f32>, PyReadonlyArray2<'_, f32>),
        triangles: PyReadonlyArray1<'_, i64>,
        ts: PyReadonlyArray1<'_, f32>,
        aims: PyReadonlyArray1<'_, u8>,
    ) -> PyResult<String> {
        let found = FoundHits::new(RayRows::new(&rays.0, &rays.1)?, &triangles, &ts, &aims)?;
        let rays: Vec<Aimed> = (0..found.ts.len()).filter_map(|place| found.ray(place)).collect();
        let hits: Vec<Option<Hit>> = (0..found.ts.len()).map(|place| found.hit(place)).collect();
        let report = py.detach(|| self.oracle.judge(&rays, &hits));
        report.map(|report| report.to_string()).map_err(|error| value_error(error.to_string()))
    }
}

fn verdict(nearest: Option<&crossbar::geom::NearestHit>, wrong: Option<&Disagreement>) -> Verdict {
    Verdict {
        kind: wrong.map_or(0, |wrong| kind_code(wrong.kind)),
        rounding: wrong.is_some_and(Disagreement::is_rounding),
        // Meshes have fewer than 2^31 triangles.
        triangle: nearest.map_or(-1, |nearest| nearest.triangle.cast_signed()),
        ties: nearest.map_or(0, |nearest| nearest.ties.len() as u32),
        t: nearest.map_or(f64::NAN, |nearest| nearest.t.to_f64()),
        ulps: -1,
    }
}

/// ULPs of f32 between the given and the exact t; -1 if either is missing or not finite.
fn t_ulps(nearest: Option<&crossbar::geom::NearestHit>, hit: Option<Hit>) -> i64 {
    let steps = nearest.zip(hit).and_then(|(nearest, hit)| crossbar::compare::f32_ulps(nearest.t.to_f32(), hit.t));
    steps.map_or(-1, |steps| steps.cast_signed())
}

/// Origins, directions and aim codes of at most `each` hard rays per aim.
#[pyfunction]
pub(crate) fn hard_rays<'py>(
    py: Python<'py>,
    vertices: PyReadonlyArray2<'_, f32>,
    faces: PyReadonlyArray2<'_, u32>,
    each: usize,
    seed: u64,
) -> PyResult<(Column<'py, f32>, Column<'py, f32>, Column<'py, u8>)> {
    let mesh = mesh(&vertices, &faces)?;
    let rays = py.detach(|| library::hard_rays(&mesh, each, seed));
    let flat =
        |of: fn(&Ray) -> [f32; 3]| rays.iter().flat_map(|hard| of(&hard.ray)).collect::<Vec<f32>>().into_pyarray(py);
    let aims = rays.iter().map(|hard| aim_code(Some(hard.aim))).collect::<Vec<u8>>().into_pyarray(py);
    Ok((flat(Ray::origin), flat(Ray::direction), aims))
}

//! The leaky teapot's tables, files and page.

use super::leaky_teapot::{Outcome, Parameters, Row};
use crate::report::picture::rgb8;
use crate::report::{Cell, Channel, Figure, Page, Provenance, ReportError, Table, exr};

/// A file to write: its name and its contents.
pub type NamedFile = (String, Vec<u8>);

/// The rows' names, formats and switches.
fn head(row: &Row) -> [Cell; 4] {
    let profile = &row.configuration.profile;
    let switch = row.configuration.switch.as_ref().map(|(name, value)| format!("{name}={value}"));
    [
        row.configuration.label.as_str().into(),
        profile.name.as_str().into(),
        profile.rules.format.to_string().into(),
        switch.unwrap_or_else(|| "-".to_owned()).into(),
    ]
}

/// The two tables: eye rays, and rays aimed at shared edges and vertices.
pub fn tables(outcome: &Outcome) -> [Table; 2] {
    let mut rows = Table::new(
        "Eye rays against exact first hits",
        &[
            "row",
            "device",
            "format",
            "switch",
            "hits",
            "leaks",
            "false_hits",
            "wrong_triangle",
            "wrong_not_adjacent",
            "largest_t_error",
            "pixels_differing",
        ],
    );
    let mut edges = Table::new(
        "Rays aimed at shared edges and vertices: leaks where the surface is whole",
        &[
            "row",
            "device",
            "format",
            "switch",
            "edge_rays",
            "edge_leaks",
            "edge_leak_percent",
            "vertex_rays",
            "vertex_leaks",
            "vertex_leak_percent",
        ],
    );
    for row in &outcome.rows {
        let t = &row.tally;
        let counts: [Cell; 7] = [
            t.hits.into(),
            t.leaks.into(),
            t.false_hits.into(),
            t.wrong_triangle.into(),
            (t.wrong_triangle - t.wrong_adjacent).into(),
            rounded(t.largest_t_error, 1e6).into(),
            row.pixels_differing.into(),
        ];
        rows.push(head(row).into_iter().chain(counts));
        let (e, v) = (&row.edges, &row.vertices);
        let shares: [Cell; 6] = [
            e.surface.into(),
            e.leaks.into(),
            rounded(100.0 * e.leak_share(), 1e3).into(),
            v.surface.into(),
            v.leaks.into(),
            rounded(100.0 * v.leak_share(), 1e3).into(),
        ];
        edges.push(head(row).into_iter().chain(shares));
    }
    [rows, edges]
}

/// `x` in steps of `1 / steps`, for people.
fn rounded(x: f64, steps: f64) -> f64 {
    (x * steps).round() / steps
}

/// A row, and the rows after it that answered every eye ray alike, to the bit.
struct Group<'a> {
    row: &'a Row,
    same: Vec<&'a Row>,
}

/// The rows by what they answered: most switches decide what these programs never ask.
fn groups(outcome: &Outcome) -> Vec<Group<'_>> {
    let mut groups: Vec<Group<'_>> = Vec::new();
    for row in &outcome.rows {
        let alike = |g: &&mut Group<'_>| {
            let bits = |t: &[f32]| t.iter().map(|t| t.to_bits()).collect::<Vec<_>>();
            g.row.triangle == row.triangle && bits(&g.row.t) == bits(&row.t)
        };
        match groups.iter_mut().find(alike) {
            Some(group) => group.same.push(row),
            None => groups.push(Group { row, same: Vec::new() }),
        }
    }
    groups
}

impl Group<'_> {
    /// `, and the same bits with a, b and c`
    fn others(&self) -> String {
        let names: Vec<String> = self
            .same
            .iter()
            .map(|row| match &row.configuration.switch {
                Some((name, value)) => format!("{name}={value}"),
                None => row.configuration.label.clone(),
            })
            .collect();
        if names.is_empty() { String::new() } else { format!(". The same bits with {}", names.join(", ")) }
    }
}

/// Everything that goes into the output folder, `index.html` last.
///
/// # Errors
/// If an encoder refuses.
pub fn files(
    parameters: &Parameters,
    outcome: &Outcome,
    provenance: &Provenance,
) -> Result<Vec<NamedFile>, ReportError> {
    let (width, height) = (parameters.view.width() as usize, parameters.view.height() as usize);
    let layers = |t: &[f32], triangle: &[u32]| {
        exr(width, height, &[("t", Channel::Float(t)), ("triangle", Channel::Uint(triangle))])
    };
    let mut files = vec![
        ("exact.png".to_owned(), rgb8(width, height, &outcome.exact_picture)?),
        ("exact.exr".to_owned(), layers(&outcome.exact_t, &outcome.exact_triangle)?),
    ];
    for row in &outcome.rows {
        let label = &row.configuration.label;
        files.push((format!("{label}.png"), rgb8(width, height, &row.picture)?));
        files.push((format!("{label}-map.png"), rgb8(width, height, &row.map)?));
        files.push((format!("{label}.exr"), layers(&row.t, &row.triangle)?));
    }
    let [rows, edges] = tables(outcome);
    files.push(("rows.csv".to_owned(), rows.csv()?.into_bytes()));
    files.push(("edges.csv".to_owned(), edges.csv()?.into_bytes()));
    let json = serde_json::json!({ "provenance": provenance, "rows": rows.json(), "edges": edges.json() });
    files.push(("study.json".to_owned(), format!("{json:#}\n").into_bytes()));
    let page = page(parameters, outcome, provenance.clone())?;
    files.push(("index.html".to_owned(), page.html().into_bytes()));
    Ok(files)
}

/// Pictures side by side, then maps; one of each for every group of rows that answered alike.
fn figures(parameters: &Parameters, outcome: &Outcome) -> Result<[Vec<Figure>; 2], ReportError> {
    let (width, height) = (parameters.view.width() as usize, parameters.view.height() as usize);
    let mut pictures = vec![Figure::new(rgb8(width, height, &outcome.exact_picture)?, "exact arithmetic")];
    let mut maps = Vec::new();
    for group in groups(outcome) {
        let (label, t) = (&group.row.configuration.label, &group.row.tally);
        let caption = format!("{label}: {} leaks{}", t.leaks, group.others());
        pictures.push(Figure::new(rgb8(width, height, &group.row.picture)?, caption));
        let caption =
            format!("{label}: {} leaks, {} false hits, {} wrong triangles", t.leaks, t.false_hits, t.wrong_triangle);
        maps.push(Figure::new(rgb8(width, height, &group.row.map)?, caption));
    }
    Ok([pictures, maps])
}

fn page(parameters: &Parameters, outcome: &Outcome, provenance: Provenance) -> Result<Page, ReportError> {
    let [pictures, maps] = figures(parameters, outcome)?;
    let [rows, edges] = tables(outcome);
    let page = Page::new("The leaky teapot", provenance)
        .text(format!(
            "Figure 4 of the Ray Engine paper (Carr, Hall, Hart 2002), on an emulated card: {} eye rays and {} triangles, in \
             several number formats, judged against first hits that are decided in exact arithmetic on the same inputs.",
            parameters.view.rays().len(),
            parameters.mesh.len(),
        ))
        .heading("The pictures")
        .figures(pictures)
        .heading("What is wrong where")
        .text(
            "Red: a leak, no hit where the surface is. Blue: a false hit. Yellow: a wrong triangle that touches the right one. \
             Orange: a wrong triangle that does not. Grey: right.",
        )
        .figures(maps)
        .heading("The figures")
        .text(
            "largest_t_error is in multiples of the ray's direction. A pixel differs if its shaded colour does. r200 rows: the \
             card as its profile has it, then each open question of the hardware answered otherwise, one at a time.",
        )
        .table(rows);
    if parameters.rays_per_edge == 0 {
        return Ok(page);
    }
    Ok(page
        .heading("Aimed at the seams")
        .text(
            "The paper's equations are evaluated once for each triangle, and on a shared edge the two evaluations need not \
             agree: a ray can miss both neighbours, in any precision. These rays are aimed from the eye at random points of \
             every shared edge, and at every vertex; counted are those that truly hit.",
        )
        .table(edges))
}

//! The leaky teapot's tables, pictures and page.

use super::{Parameters, TeapotOutcome, TeapotRow};
use crate::picture::{ChannelUnit, Picture, PictureError, Samples};
use crate::report::{Cell, Findings, FoundTable, NamedPicture, ReportError, Table};

/// The rows' names, formats and switches.
fn head(row: &TeapotRow) -> [Cell; 4] {
    let profile = &row.configuration.profile;
    let switch = row.configuration.switch.as_ref().map(|(name, value)| format!("{name}={value}"));
    [
        row.configuration.label.as_str().into(),
        profile.name.as_str().into(),
        profile.rules.format.to_string().into(),
        switch.unwrap_or_else(|| "-".to_owned()).into(),
    ]
}

/// The two tables: eye rays, and rays aimed at shared edges and vertices, if any were.
fn tables(parameters: &Parameters, outcome: &TeapotOutcome) -> [Table; 2] {
    let mut rows = Table::of(
        "Eye rays against exact first hits",
        "row hits leaks false_hits wrong_triangle wrong_not_adjacent largest_t_error pixels_differing device format \
         switch",
    );
    let mut edges = Table::of(
        "Rays aimed at shared edges and vertices: leaks where the surface is whole",
        "row edge_rays edge_leaks edge_leak_percent vertex_rays vertex_leaks vertex_leak_percent device format switch",
    );
    for row in &outcome.rows {
        let t = &row.tally;
        let counts: [Cell; 7] = [
            t.hits.into(),
            t.leaks.into(),
            t.false_hits.into(),
            t.wrong_triangle.into(),
            (t.wrong_triangle - t.wrong_adjacent).into(),
            Cell::error(t.largest_t_error),
            row.pixels_differing.into(),
        ];
        let [label, device, format, switch] = head(row);
        rows.push([label].into_iter().chain(counts).chain([device, format, switch]));
        if parameters.rays_per_edge == 0 {
            continue;
        }
        let (e, v) = (&row.edges, &row.vertices);
        let shares: [Cell; 6] = [
            e.surface.into(),
            e.leaks.into(),
            Cell::percent(100.0 * e.leak_share()),
            v.surface.into(),
            v.leaks.into(),
            Cell::percent(100.0 * v.leak_share()),
        ];
        let [label, device, format, switch] = head(row);
        edges.push([label].into_iter().chain(shares).chain([device, format, switch]));
    }
    [rows, edges]
}

/// For each row the first that has the same hits to the bit, and the same counts of aimed rays.
fn first_alike(outcome: &TeapotOutcome) -> Vec<usize> {
    let bits = |row: &TeapotRow| row.t.iter().map(|t| t.to_bits()).collect::<Vec<_>>();
    let alike = |a: &TeapotRow, b: &TeapotRow| {
        (&a.triangle, a.edges, a.vertices) == (&b.triangle, b.edges, b.vertices) && bits(a) == bits(b)
    };
    let rows = &outcome.rows;
    let first = |(i, row): (usize, &TeapotRow)| rows[..i].iter().position(|other| alike(other, row)).unwrap_or(i);
    rows.iter().enumerate().map(first).collect()
}

/// What a row is called among others like it: by its switch, if one was turned.
fn called(row: &TeapotRow) -> String {
    let switch = row.configuration.switch.as_ref().map(|(name, value)| format!("{name}={value}"));
    switch.unwrap_or_else(|| row.configuration.label.clone())
}

/// A row, and the rows after it with the same hits to the bit.
struct Group<'a> {
    row: &'a TeapotRow,
    same: Vec<&'a TeapotRow>,
}

/// The rows by their hits: most switches change nothing for these programs.
fn groups(outcome: &TeapotOutcome) -> Vec<Group<'_>> {
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
        let names: Vec<String> = self.same.iter().map(|row| called(row)).collect();
        if names.is_empty() { String::new() } else { format!(". The same bits with {}", names.join(", ")) }
    }
}

/// First hits as layers.
fn layers(parameters: &Parameters, t: Vec<f32>, triangles: Vec<u32>) -> Result<Picture, PictureError> {
    Picture::new(parameters.view.width(), parameters.view.height())
        .with("t", ChannelUnit::RayLength, Samples::Float(t))?
        .with("triangle", ChannelUnit::Id, Samples::Uint(triangles))
}

pub(super) fn findings(parameters: &Parameters, outcome: TeapotOutcome) -> Result<Findings, ReportError> {
    let mut found = Findings::new("The leaky teapot");
    let [rows, edges] = tables(parameters, &outcome);
    let (first, names): (Vec<usize>, Vec<String>) = (first_alike(&outcome), outcome.rows.iter().map(called).collect());
    let switched = outcome.rows.iter().any(|row| row.configuration.switch.is_some());
    let of = if switched { ["switch", "switches"] } else { ["row", "rows"] };
    let folded = |table: Table, same| FoundTable::from(table).folded(&first, |row| names[row].clone(), (of, same));
    let (rows, edges) = (folded(rows, "the same bits"), folded(edges, "the same counts"));
    // One picture and one map of each group stand on the page.
    let mut pictures = vec![NamedPicture::new("exact", outcome.exact_picture.clone(), "exact arithmetic")];
    let mut maps = Vec::new();
    for group in groups(&outcome) {
        let (label, t) = (&group.row.configuration.label, &group.row.tally);
        let caption = format!("{label}: {} leaks{}", t.leaks, group.others());
        pictures.push(NamedPicture::new(label, group.row.picture.clone(), caption));
        let caption =
            format!("{label}: {} leaks, {} false hits, {} wrong triangles", t.leaks, t.false_hits, t.wrong_triangle);
        maps.push(NamedPicture::new(format!("{label}-map"), group.row.map.clone(), caption));
        for same in group.same {
            found.keep_picture(&same.configuration.label, same.picture.clone());
            found.keep_picture(format!("{}-map", same.configuration.label), same.map.clone());
        }
    }
    found.keep_layers("exact", layers(parameters, outcome.exact_t, outcome.exact_triangle)?);
    for row in outcome.rows {
        found.keep_layers(&row.configuration.label, layers(parameters, row.t, row.triangle)?);
    }
    found.paragraph(format!(
        "Figure 4 of the Ray Engine paper (Carr, Hall, Hart 2002), on an emulated card: {} eye rays and {} triangles, in \
         several number formats, judged against first hits that are decided in exact arithmetic on the same inputs.",
        parameters.view.rays().len(),
        parameters.mesh.len(),
    ));
    found.heading("The pictures");
    found.pictures(pictures);
    found.heading("What is wrong where");
    found.paragraph(
        "Red: a leak, no hit where the surface is. Blue: a false hit. Yellow: a wrong triangle that touches the right one. \
         Orange: a wrong triangle that does not. Grey: right.",
    );
    found.pictures(maps);
    found.heading("The figures");
    found.paragraph(
        "largest_t_error is in multiples of the ray's direction. A pixel differs if its shaded colour does. r200 rows: the \
         card as its profile has it, then each open question of the hardware answered otherwise, one at a time.",
    );
    found.table(rows.csv("rows").field("rows"));
    if parameters.rays_per_edge > 0 {
        found.heading("Aimed at the seams");
        found.paragraph(
            "The paper's equations are evaluated once for each triangle, and on a shared edge the two evaluations need not \
             agree: a ray can miss both neighbours, in any precision. These rays are aimed from the eye at random points of \
             every shared edge, and at every vertex; counted are those that truly hit.",
        );
    }
    found.table(edges.csv("edges").field("edges"));
    Ok(found)
}

//! Tables, pictures and page of the study.

use std::cmp::Reverse;

use serde_json::{Map, Value, json};

use super::conclusion::{MAX_NAMES, conclude, is_row, name};
use super::{Parameters, PixelVerdict, TeapotOutcome, TeapotRow};
use crate::error::InputError;
use crate::picture::{ChannelUnit, Picture, Samples};
use crate::ray_engine::EdgeRule;
use crate::report::words::{counted, listed};
use crate::report::{Cell, Findings, FoundTable, NamedPicture, Table};

/// Name, format and switch of a row.
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

/// Builds the two tables: eye rays, and rays aimed at shared edges and vertices, if there were any.
fn tables(parameters: &Parameters, outcome: &TeapotOutcome) -> [Table; 2] {
    let mut rows = Table::of(
        if parameters.listed.is_some() { "Rays against exact first hits" } else { "Eye rays against exact first hits" },
        "row hits leaks false_hits wrong_triangle wrong_not_adjacent largest_t_error pixels_differing device format \
         switch",
    );
    let mut edges = Table::of(
        "Leaks of rays aimed at shared edges and at vertices, outlines included",
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
        if !aimed(parameters) {
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

/// Builds the table of the programs: leaks inside the surface, and what an intersection costs. Switches that are traced
/// by the paper's program alone are left out.
fn programs(outcome: &TeapotOutcome) -> Table {
    let mut programs = Table::of(
        "Leaks inside the surface, away from outlines, and the cost of an intersection",
        "row edges edge_rays edge_leaks vertex_rays vertex_leaks eye_rays eye_leaks arithmetic_slots texture_slots clocks \
         format",
    );
    let shared: Vec<_> = outcome.rows.iter().filter(|row| row.edge_rule == EdgeRule::SharedEdges).collect();
    let same = |a: &TeapotRow, b: &TeapotRow| {
        let [a, b] = [a, b].map(|row| (&row.configuration.profile.name, &row.configuration.switch));
        a == b
    };
    for row in &outcome.rows {
        if row.configuration.switch.is_some() && !shared.iter().any(|other| same(row, other)) {
            continue;
        }
        let [eye, edges, vertices] = row.holes;
        let counts = [edges, vertices, eye]
            .into_iter()
            .flat_map(|holes| -> [Cell; 2] { [holes.rays.into(), holes.leaks.into()] });
        let rule = match row.edge_rule {
            EdgeRule::Paper => "paper",
            EdgeRule::SharedEdges => "shared",
        };
        let cost = row.cost;
        let costs: [Cell; 3] = [cost.arithmetic.into(), cost.texture.into(), cost.clocks.into()];
        let [label, _, format, _] = head(row);
        programs.push([label, rule.into()].into_iter().chain(counts).chain(costs).chain([format]));
    }
    programs
}

/// Returns `true` if rays were aimed at edges and vertices: some are requested per edge, and the eye rays have one
/// origin.
fn aimed(parameters: &Parameters) -> bool {
    parameters.options.rays_per_edge > 0 && parameters.view.common_origin().is_some()
}

/// Returns `true` if two rows have the same hits, bit for bit.
fn same_hits(a: &TeapotRow, b: &TeapotRow) -> bool {
    let bits = |row: &TeapotRow| row.t.iter().map(|t| t.to_bits()).collect::<Vec<_>>();
    a.triangle == b.triangle && bits(a) == bits(b)
}

/// For each row, the index of the first row that equals it by `alike`.
fn first_alike(rows: &[TeapotRow], alike: impl Fn(&TeapotRow, &TeapotRow) -> bool) -> Vec<usize> {
    let first = |(i, row): (usize, &TeapotRow)| rows[..i].iter().position(|other| alike(other, row)).unwrap_or(i);
    rows.iter().enumerate().map(first).collect()
}

/// Name of a row within its group: its switch, if one was changed.
fn called(row: &TeapotRow) -> String {
    let switch = row.configuration.switch.as_ref().map(|(name, value)| format!("{name}={value}"));
    switch.unwrap_or_else(|| row.configuration.label.clone())
}

/// Row, and the later rows with bit-identical hits.
struct Group<'a> {
    row: &'a TeapotRow,
    same: Vec<&'a TeapotRow>,
}

/// Groups the rows by their hits: most switches change nothing for these programs.
fn groups(rows: &[TeapotRow]) -> Vec<Group<'_>> {
    let first = first_alike(rows, same_hits);
    let same = |at: usize| (at + 1..rows.len()).filter(|other| first[*other] == at).map(|other| &rows[other]).collect();
    let leaders = (0..rows.len()).filter(|at| first[*at] == *at);
    leaders.map(|at| Group { row: &rows[at], same: same(at) }).collect()
}

/// Maps each row without files of its own to the row with the same bits whose files represent it.
fn same_bits(groups: &[Group<'_>]) -> Value {
    let pair = |row: &TeapotRow, other: &TeapotRow| (row.configuration.label.clone(), json!(other.configuration.label));
    groups.iter().flat_map(|group| group.same.iter().map(|row| pair(row, group.row))).collect::<Map<_, _>>().into()
}

impl Group<'_> {
    /// Lists the other rows, which the tables name: `. The same bits as a and b`
    fn others(&self) -> String {
        let names: Vec<String> = self.same.iter().map(|row| called(row)).collect();
        match names.len() {
            0 => String::new(),
            1..=MAX_NAMES => format!(". The same bits as {}", listed(&names)),
            _ => format!(". The same bits as {} other rows", names.len()),
        }
    }
}

/// Encodes first hits as picture layers.
fn layers(parameters: &Parameters, t: Vec<f32>, triangles: Vec<u32>) -> Result<Picture, InputError> {
    Picture::new(parameters.view.width(), parameters.view.height())
        .with("t", ChannelUnit::RayLength, Samples::Float(t))?
        .with("triangle", ChannelUnit::Id, Samples::Uint(triangles))
}

/// Picture and map of a row, side by side.
fn pair(group: &Group<'_>) -> [NamedPicture; 2] {
    let row = group.row;
    let (label, name, t) = (&row.configuration.label, name(row), &row.tally);
    let leaks = counted(t.leaks, "leak", "leaks");
    let counts = [
        leaks.clone(),
        counted(t.false_hits, "false hit", "false hits"),
        counted(t.wrong_triangle, "wrong triangle", "wrong triangles"),
    ];
    [
        NamedPicture::new(label, row.picture.clone(), format!("{name}: {leaks}{}", group.others())),
        NamedPicture::new(
            format!("{label}-map"),
            row.map.clone(),
            format!("{name}, map of the errors: {}", listed(&counts)),
        ),
    ]
}

pub(super) fn findings(parameters: &Parameters, outcome: TeapotOutcome) -> Result<Findings, InputError> {
    let title = parameters.model.as_ref().map(|model| format!("Leaks of {model}"));
    let mut found = Findings::new(title.as_deref().unwrap_or("The leaky teapot"));
    let unit = if parameters.listed.is_some() { ["ray", "rays"] } else { ["pixel", "pixels"] };
    conclude(&mut found, &outcome.rows, &unit);
    pictures(&mut found, parameters, &outcome);
    let [rows, edges] = tables(parameters, &outcome);
    let counted_alike =
        |a: &TeapotRow, b: &TeapotRow| (a.edges, a.vertices) == (b.edges, b.vertices) && same_hits(a, b);
    let first = first_alike(&outcome.rows, counted_alike);
    let names: Vec<String> = outcome.rows.iter().map(called).collect();
    let switched = outcome.rows.iter().any(|row| row.configuration.switch.is_some());
    let of = if switched { ["switch", "switches"] } else { ["row", "rows"] };
    let folded = |table: Table, same| FoundTable::from(table).folded(&first, |row| names[row].clone(), (of, same));
    let (rows, edges) = (folded(rows, "the same bits"), folded(edges, "the same counts"));
    let programs = (aimed(parameters) && !parameters.shared.is_empty()).then(|| programs(&outcome));
    let groups = groups(&outcome.rows);
    // Files of rows with the same bits would be copies.
    found.field("same_bits", same_bits(&groups));
    found.keep_layers("exact", layers(parameters, outcome.exact_t, outcome.exact_triangle)?);
    for Group { row, .. } in &groups {
        found.keep_layers(&row.configuration.label, layers(parameters, row.t.clone(), row.triangle.clone())?);
    }
    found.heading("The figures");
    found.paragraph(
        "largest_t_error counts multiples of the ray's direction. pixels_differing counts pixels whose shaded color \
         differs. The r200 rows are the card as in its profile, then with each open switch of the hardware changed, \
         one at a time.",
    );
    found.table(rows.csv("rows").field("rows"));
    if aimed(parameters) {
        found.heading("Aimed at the seams");
        found.paragraph(
            "The paper's equations are evaluated once for each triangle, and on a shared edge the two results need not \
             agree: a ray can miss both neighbouring triangles, in any precision. These rays are aimed from the eye at \
             random points of every shared edge, and at every vertex; only rays that hit in exact arithmetic are \
             counted. A miss at an outline counts as a leak too.",
        );
    }
    found.table(edges.csv("edges").field("edges"));
    if let Some(programs) = programs {
        found.heading("Where an edge is evaluated once");
        found.paragraph(
            "In rows with shared edges, the program sorts the corners of each triangle, and computes an edge from its \
             own two corners alone, by the same operations in both of its triangles. Both triangles get the same bits; \
             one requires at least 0, the other at most 0, so no ray is outside both. Near a vertex, rounding \
             can still put a ray outside all triangles that meet there. The table counts only rays whose first hit \
             lies where all surrounding triangles face the eye: near an outline, a miss may be right for the ray as \
             the card rounded it.",
        );
        found.table(FoundTable::from(programs).csv("programs").field("programs"));
    }
    Ok(found)
}

/// The group with the most leaks; the first one if several have as many.
fn worst(groups: &[Group<'_>]) -> Option<usize> {
    groups.iter().enumerate().min_by_key(|(_, group)| Reverse(group.row.tally.leaks)).map(|(at, _)| at)
}

/// Three groups for comparison, if all were traced and differ: the first card with shared-edge rows as it runs the
/// paper's program, the same rounded to nearest, and the card with shared edges.
fn cure(groups: &[Group<'_>]) -> Option<[usize; 3]> {
    let find = |wanted: &dyn Fn(&TeapotRow) -> bool| {
        groups.iter().position(|group| std::iter::once(&group.row).chain(&group.same).any(|row| wanted(row)))
    };
    let cured = find(&|row| row.edge_rule == EdgeRule::SharedEdges && row.configuration.switch.is_none())?;
    let card = &groups[cured].row.configuration.profile.name;
    let paper = |nearest| find(&|row| is_row(row, card, EdgeRule::Paper, nearest));
    let three = [paper(false)?, paper(true)?, cured];
    let differ = three[0] != three[1] && three[0] != three[2] && three[1] != three[2];
    differ.then_some(three)
}

/// Adds the pictures of the page: first the card that leaks with its cure, or the row that leaks most, and the exact
/// picture; then all others. One picture and one map of each group are shown on the page.
fn pictures(found: &mut Findings, parameters: &Parameters, outcome: &TeapotOutcome) {
    let mut groups = groups(&outcome.rows);
    let mut lead: Vec<NamedPicture> = Vec::new();
    let exact = NamedPicture::new("exact", outcome.exact_picture.clone(), "exact arithmetic");
    if let Some(three) = cure(&groups) {
        let pairs = three.map(|at| pair(&groups[at]));
        let [pictures, maps] = [0, 1].map(|which| pairs.iter().map(|pair| pair[which].clone()).collect::<Vec<_>>());
        found.pictures(pictures.into_iter().chain([exact]).collect());
        lead = maps;
        let mut at = 0;
        groups.retain(|_| {
            at += 1;
            !three.contains(&(at - 1))
        });
    } else if let Some(worst) = worst(&groups) {
        let [picture, map] = pair(&groups.remove(worst));
        lead.extend([picture, map, exact]);
    } else {
        lead.push(exact);
    }
    found.legend(PixelVerdict::legend());
    found.pictures(lead);
    let asked = counted(parameters.rays().len() as u64, "ray", "rays");
    let triangles = counted(parameters.mesh.len() as u64, "triangle", "triangles");
    found.paragraph(match &parameters.model {
        None => format!(
            "This is Figure 4 of the Ray Engine paper (Carr, Hall, Hart 2002) on an emulated card, with {asked} from \
             the eye and {triangles}, in several number formats. The hits are judged against first hits that are \
             decided in exact arithmetic on the same inputs. A ray leaks if it misses a surface that it should hit: \
             the paper's program evaluates the edge of two triangles once for each of them, and rounding can put the \
             ray outside both."
        ),
        Some(model) => format!(
            "An emulated card intersects {asked} with the {triangles} of {model}, by the programs of the Ray Engine \
             paper (Carr, Hall, Hart 2002). Its hits are judged against first hits that are decided in exact \
             arithmetic on the same inputs."
        ),
    });
    if parameters.listed.is_some() {
        found.paragraph(
            "The rays come from a file: pictures show them row by row, in the order of the file, one pixel per ray.",
        );
    }
    if !groups.is_empty() {
        found.heading("The other rows");
        found.legend(PixelVerdict::legend());
        found.pictures(groups.iter().flat_map(pair).collect());
    }
}

//! Binding of vertices by attribute name.

use std::collections::BTreeMap;

use refsim::{
    isa::{Program, Usage},
    raster::{Cull, Primitive, Provoking, Vertex},
};
use toml::Spanned;

use super::{
    CaseError,
    binder::{Binder, register},
    schema::{self, Convention, Shading},
    value::{Number, ONE, vector},
};

const MINUS_ONE: u32 = 0xbf80_0000;
const MAX_VERTICES: usize = 1 << 20;

#[derive(Clone, Debug)]
pub(crate) struct Geometry {
    pub(super) primitive: Primitive,
    pub(super) vertices: Vertices,
    pub(super) cull: Cull,
    /// Flat shading: the vertex that provides the colors of a primitive, by convention; `None` for smooth shading.
    pub(super) flat: Option<Provoking>,
    pub(super) convention: Convention,
}

#[derive(Clone, Debug)]
pub(super) enum Vertices {
    /// Attributes `v0` to `v15` of each vertex, for the vertex program.
    Attributes(Vec<[[u32; 4]; 16]>),
    /// Input of the rasteriser, if there is no vertex program.
    Transformed(Vec<Vertex>),
}

type Attributes = BTreeMap<String, Spanned<Vec<Number>>>;

/// Binds the geometry to the vertex program, if there is one.
pub(super) fn bind(
    binder: &Binder<'_>,
    geometry: &Spanned<schema::Geometry>,
    program: Option<&Program>,
    pixel_reads_fog: bool,
) -> Result<Geometry, CaseError> {
    let written = geometry.get_ref();
    let wrong = |message: &str, help: &str| Err(binder.place.wrong(geometry.span(), message, help));
    if written.full_screen && !written.vertices.is_empty() {
        return wrong("the geometry has both `full_screen` and `vertices`", "keep one of the two");
    }
    if !written.full_screen && written.vertices.is_empty() {
        return wrong("the geometry has no vertices", "list `vertices`, or write `full_screen = true`");
    }
    if written.vertices.len() > MAX_VERTICES {
        return wrong("the geometry has more than 1048576 vertices", "split the case");
    }
    let corners = written.full_screen.then(|| corners(written.convention)).into_iter().flatten();
    let places = written.vertices.iter().map(CaseVertex::Vertex).chain(corners.map(CaseVertex::Corner));
    let reader = Reader { binder, geometry, program, pixel_reads_fog };
    let vertices = match program {
        Some(_) => Vertices::Attributes(places.map(|place| reader.attributes(place)).collect::<Result<_, _>>()?),
        None => Vertices::Transformed(places.map(|place| reader.plain(place)).collect::<Result<_, _>>()?),
    };
    if let (true, Some(primitive)) = (written.full_screen, &written.primitive) {
        let help = "remove `primitive`: the screen is one quad";
        return Err(binder.place.wrong(primitive.span(), "both `primitive` and `full_screen`", help));
    }
    let usual = if written.full_screen { Primitive::QuadList } else { Primitive::TriangleList };
    let flat = (written.shading == Shading::Flat).then_some(match written.convention {
        Convention::Direct3d => Provoking::First,
        Convention::Opengl => Provoking::Last,
    });
    Ok(Geometry {
        primitive: written.primitive.as_ref().map_or(usual, |primitive| *primitive.get_ref()),
        vertices,
        cull: written.cull,
        flat,
        convention: written.convention,
    })
}

/// A vertex of the case, or position and `t0` of a corner of the screen.
enum CaseVertex<'a> {
    Vertex(&'a Spanned<Attributes>),
    Corner([[u32; 4]; 2]),
}

/// Corners of the screen in order; `t0` grows with columns and rows, and row 0 is at the top only in Direct3D.
fn corners(convention: Convention) -> [[[u32; 4]; 2]; 4] {
    [(0, 0), (ONE, 0), (ONE, ONE), (0, ONE)].map(|(s, t)| {
        let x = if s == 0 { MINUS_ONE } else { ONE };
        let y = if (t == 0) == (convention == Convention::Direct3d) { ONE } else { MINUS_ONE };
        [[x, y, 0, ONE], [s, t, 0, ONE]]
    })
}

struct Reader<'a> {
    binder: &'a Binder<'a>,
    geometry: &'a Spanned<schema::Geometry>,
    program: Option<&'a Program>,
    pixel_reads_fog: bool,
}

impl<'a> Reader<'a> {
    /// Default attributes of all vertices, then the attributes of this vertex.
    fn all(&self, place: &CaseVertex<'a>) -> impl Iterator<Item = (&'a String, &'a Spanned<Vec<Number>>)> {
        let own = if let CaseVertex::Vertex(written) = place { Some(written.get_ref()) } else { None };
        self.geometry.get_ref().attributes.iter().chain(own.into_iter().flatten())
    }

    fn plain(&self, place: CaseVertex<'a>) -> Result<Vertex, CaseError> {
        let mut vertex = Vertex::default();
        let position = self.all(&place).find(|(name, _)| *name == "position");
        match (&place, position) {
            (CaseVertex::Vertex(written), None) => {
                let help =
                    "write for example `position = [-1, 1]`: in clip space; z is 0 and w is 1 if they are omitted";
                return Err(self.binder.place.wrong(written.span(), "the vertex has no `position`", help));
            }
            (CaseVertex::Corner(_), Some((_, value))) => {
                let help = "the corners of a full-screen quad have fixed positions";
                return Err(self.binder.place.wrong(value.span(), "both `position` and `full_screen`", help));
            }
            (CaseVertex::Corner(corner), None) => [vertex.position, vertex.texcoords[0]] = *corner,
            (CaseVertex::Vertex(_), Some(_)) => {}
        }
        for (name, value) in self.all(&place) {
            self.set(&mut vertex, name, value)?;
        }
        Ok(vertex)
    }

    fn set(&self, vertex: &mut Vertex, name: &str, value: &Spanned<Vec<Number>>) -> Result<(), CaseError> {
        let bits = self.bits(value)?;
        let numbered =
            |letter: char, count| Some(name).filter(|name| name.starts_with(letter)).and_then(|n| register(n, count));
        if name == "position" {
            vertex.position = bits;
        } else if let Some(color) = numbered('v', 2) {
            vertex.colors[color] = bits;
        } else if let Some(set) = numbered('t', 8) {
            vertex.texcoords[set] = bits;
        } else if name != "fog" {
            let message = format!("expected position, v0, v1, t0 to t7 or fog, found `{name}`");
            let help = "without [vertex], the vertices give the pixel program's inputs";
            return Err(self.binder.place.wrong(value.span(), message, help));
        } else if !self.pixel_reads_fog {
            let message = "the vertex has `fog`, but the pixel program reads no fog coordinate";
            let help = "remove `fog`, or read it in the program, as `f[FOGC]` or `fragment.fogcoord`: fixed-function fog is not emulated";
            return Err(self.binder.place.wrong(value.span(), message, help));
        } else {
            vertex.fog = bits[0];
        }
        Ok(())
    }

    fn attributes(&self, place: CaseVertex<'a>) -> Result<[[u32; 4]; 16], CaseError> {
        let mut registers = [[0, 0, 0, ONE]; 16];
        for (name, value) in self.all(&place) {
            registers[self.attribute(name, value.span())?] = self.bits(value)?;
        }
        if let CaseVertex::Corner([position, t0]) = place {
            registers[self.attribute("position", self.geometry.span())?] = position;
            // Only a program that declares texture coordinates receives them.
            if let Some(number) = self.declared("t0") {
                registers[number] = t0;
            }
        }
        Ok(registers)
    }

    fn attribute(&self, name: &str, span: std::ops::Range<usize>) -> Result<usize, CaseError> {
        let direct = if name.starts_with('v') { register(name, 16) } else { None };
        direct.or_else(|| self.declared(name)).ok_or_else(|| {
            let message = format!("the vertex program declares no input for `{name}`");
            let help = "use v0 to v15, or position, normal, color0, color1, t0 to t15 as the program's dcl lines say";
            self.binder.place.wrong(span, message, help)
        })
    }

    fn declared(&self, name: &str) -> Option<usize> {
        let usage = match name {
            "position" => Usage::Position(0),
            "normal" => Usage::Normal(0),
            "color0" => Usage::Color(0),
            "color1" => Usage::Color(1),
            _ if name.starts_with('t') => Usage::TexCoord(u8::try_from(register(name, 16)?).ok()?),
            _ => return None,
        };
        let declaration = self.program?.declarations.iter().find(|declaration| declaration.usage == usage)?;
        Some(usize::from(declaration.destination.register.index)).filter(|number| *number < 16)
    }

    fn bits(&self, value: &Spanned<Vec<Number>>) -> Result<[u32; 4], CaseError> {
        vector(value.get_ref()).ok_or_else(|| {
            let message = format!("expected 1 to 4 numbers, found {}", value.get_ref().len());
            self.binder.place.wrong(value.span(), message, "missing components are 0, 0, 0, 1")
        })
    }
}

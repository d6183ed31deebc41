//! Random programs of OpenGL's two languages.

use super::{Layout, component, mask, values};
use crate::random::Random;
use refsim::isa::{
    ConditionTest, FogMode, LightingColor, MAX_LIGHTS, MAX_PROGRAM_MATRICES, MAX_TEXTURE_UNITS, MaterialFace,
    MatrixForm, Opcode, OpcodeClass, Spelling, StateBinding, StateMatrix, Version,
};
use refsim::texture::TextureKind;

/// Any state that a program can name.
fn state(r: &mut Random) -> StateBinding {
    use StateBinding as B;
    let face = r.of(&[MaterialFace::Front, MaterialFace::Back]);
    let color = r.of(&[LightingColor::Ambient, LightingColor::Diffuse, LightingColor::Specular]);
    let light = r.below(MAX_LIGHTS) as u8;
    let unit = r.below(MAX_TEXTURE_UNITS) as u8;
    let own = r.below(MAX_PROGRAM_MATRICES) as u8;
    let matrices = [
        StateMatrix::ModelView,
        StateMatrix::Projection,
        StateMatrix::Mvp,
        StateMatrix::Texture(unit),
        StateMatrix::Program(own),
    ];
    let matrix = r.of(&matrices);
    let form = r.of(&[MatrixForm::Plain, MatrixForm::Inverse, MatrixForm::Transpose, MatrixForm::InvTrans]);
    let row = B::MatrixRow(matrix, form, r.below(4) as u8);
    r.of(&[
        B::Material(face, color),
        B::Emission(face),
        B::Shininess(face),
        B::Light(light, color),
        B::LightPosition(light),
        B::LightAttenuation(light),
        B::SpotDirection(light),
        B::LightHalf(light),
        B::LightModelAmbient,
        B::SceneColor(face),
        B::LightProduct(light, face, color),
        B::TextureEnvironment(unit),
        B::FogColor,
        B::FogParams,
        B::DepthRange,
        row,
        row,
        row,
    ])
}

/// State of a program while it is written.
struct Writer<'a> {
    nv: bool,
    layout: &'a Layout,
    r: &'a mut Random,
    lines: &'a mut Vec<String>,
    /// Temporaries in use, per precision.
    temps: usize,
    /// The attribute and the constant that the current instruction may read.
    attribute: String,
    constant: String,
}

/// A program of one of OpenGL's two languages, mostly legal.
pub(crate) fn program(version: Version, layout: &Layout, size: usize, r: &mut Random) -> Vec<String> {
    let mut lines = vec![version.token().to_owned()];
    let temps = 2 + r.below(4);
    let nv = version == Version::Fp1_0;
    let mut w = Writer { nv, layout, r, lines: &mut lines, temps, attribute: String::new(), constant: String::new() };
    w.begin();
    let spellings: Vec<&Spelling> = Spelling::ALL.iter().filter(|s| s.opcode.info().available(version)).collect();
    let count = [3, 8, 16, 28][size.min(3)];
    for _ in 0..1 + w.r.below(count) {
        let line = w.instruction(version, &spellings);
        w.lines.push(line);
    }
    w.outputs();
    w.lines.push("END".to_owned());
    lines
}

impl Writer<'_> {
    fn begin(&mut self) {
        if !self.nv {
            if self.r.one_in(8) {
                self.lines.push("OPTION ARB_precision_hint_nicest;".to_owned());
            }
            if self.r.one_in(4) {
                self.lines.push(format!("OPTION {};", self.r.of(&FogMode::ALL).name()));
            }
            for n in 0..self.temps {
                self.lines.push(format!("TEMP R{n};"));
            }
        }
        let value = values(self.r, 2.0);
        self.lines.push(if self.nv {
            format!("DEFINE half = {{{value}}};")
        } else {
            format!("PARAM half = {{{value}}};")
        });
        for n in 0..self.temps {
            self.choose();
            let attribute = self.attribute.clone();
            self.lines.push(format!("MOV R{n}, {attribute};"));
            if self.nv {
                let constant = self.constant.clone();
                self.lines.push(format!("MOV H{n}, {constant};"));
            }
        }
    }

    /// Chooses the attribute and the constant for the next instruction.
    fn choose(&mut self) {
        let n = self.r.below(8);
        let nv = self.nv;
        self.attribute = match self.r.below(7) {
            0 if nv => "f[COL0]".to_owned(),
            1 if nv => "f[COL1]".to_owned(),
            2 if nv => "f[FOGC]".to_owned(),
            3 if nv => "f[WPOS]".to_owned(),
            0 => "fragment.color".to_owned(),
            1 => "fragment.color.secondary".to_owned(),
            2 => "fragment.fogcoord".to_owned(),
            3 => "fragment.position".to_owned(),
            _ if nv => format!("f[TEX{n}]"),
            _ => format!("fragment.texcoord[{n}]"),
        };
        let p = self.r.below(12);
        self.constant = match self.r.below(6) {
            0 => "half".to_owned(),
            1 => format!("{{{}}}", values(self.r, 2.0)),
            2 => format!("{:.3}", self.r.below(17) as f32 / 8.0),
            3 if !nv => state(self.r).to_string(),
            _ if nv => format!("p[{p}]"),
            _ => format!("program.local[{p}]"),
        };
    }

    fn register(&mut self) -> String {
        let n = self.r.below(self.temps);
        match self.r.below(8) {
            0 => self.attribute.clone(),
            1 => self.constant.clone(),
            2..=4 if self.nv => format!("H{n}"),
            _ => format!("R{n}"),
        }
    }

    fn source(&mut self, scalar: bool) -> String {
        let register = self.register();
        let swizzle = match self.r.below(3) {
            _ if scalar => format!(".{}", component(self.r)),
            0 => format!(".{}", component(self.r)),
            1 => {
                let four: String = (0..4).map(|_| component(self.r)).collect();
                format!(".{four}")
            }
            _ => String::new(),
        };
        let swizzle =
            if register.starts_with(|c: char| c.is_ascii_digit()) && !scalar { String::new() } else { swizzle };
        match self.r.below(6) {
            0 => format!("-{register}{swizzle}"),
            1 if self.nv => format!("|{register}{swizzle}|"),
            2 if self.nv => format!("-|{register}{swizzle}|"),
            _ => format!("{register}{swizzle}"),
        }
    }

    fn condition(&mut self) -> String {
        let test = ConditionTest::ALL[self.r.below(8)].name();
        let swizzle = match self.r.below(3) {
            0 => format!(".{}", component(self.r)),
            1 => (0..4).fold(".".to_owned(), |s, _| s + component(self.r)),
            _ => String::new(),
        };
        format!("{test}{swizzle}")
    }

    fn destination(&mut self, full: bool) -> String {
        let n = self.r.below(self.temps);
        let register = match self.r.below(8) {
            0 if self.nv => self.r.of(&["RC", "HC"]).to_owned(),
            1..=3 if self.nv => format!("H{n}"),
            _ => format!("R{n}"),
        };
        let register = if full && !register.starts_with('R') { format!("R{n}") } else { register };
        let mask = mask(self.r);
        let condition = if self.nv && self.r.one_in(3) { format!(" ({})", self.condition()) } else { String::new() };
        format!("{register}{mask}{condition}")
    }

    fn name(&mut self, s: &Spelling) -> String {
        let mut name = s.name.to_owned();
        if self.nv {
            let all: &[&str] = match (s.floats, s.fixed) {
                (true, true) => &["R", "H", "X", ""],
                (true, false) => &["R", "H", ""],
                _ => &[""],
            };
            name += self.r.of(all);
            if s.result && self.r.one_in(3) {
                name.push('C');
            }
        }
        if s.result && self.r.one_in(5) {
            name += "_SAT";
        }
        name
    }

    fn instruction(&mut self, version: Version, all: &[&Spelling]) -> String {
        self.choose();
        let sampling = self.layout.sampling && self.r.one_in(2);
        let texture = |s: &&&Spelling| s.opcode.info().class == OpcodeClass::Texture && s.opcode != Opcode::Kil;
        let s = match sampling {
            true => {
                let reads: Vec<&&Spelling> = all.iter().filter(texture).collect();
                *reads[self.r.below(reads.len())]
            }
            false => all[self.r.below(all.len())],
        };
        let is_texture = texture(&&s);
        if s.opcode == Opcode::Kil {
            // Kill instructions must be rare; otherwise no fragments are left.
            if !self.r.one_in(4) {
                return format!("MOV R0, R{};", self.r.below(self.temps));
            }
            return match self.nv {
                true => format!("KIL {};", self.condition()),
                false => format!("KIL {};", self.source(false)),
            };
        }
        let full = s.name.starts_with("PK");
        let mut line = format!("{} {}", self.name(s), self.destination(full));
        if s.opcode == Opcode::Swz {
            let parts: Vec<String> =
                (0..4).map(|_| self.r.of(&["", "-"]).to_owned() + self.r.of(&["x", "y", "z", "w", "0", "1"])).collect();
            return format!("{line}, R{}, {};", self.r.below(self.temps), parts.join(", "));
        }
        let count = usize::from(s.opcode.info().source_count(version).unwrap_or(0)) - usize::from(is_texture);
        for _ in 0..count {
            let source = match s.name.starts_with("UP") {
                true => format!("R{}.{}", self.r.below(self.temps), component(self.r)),
                false => self.source(s.opcode.is_scalar()),
            };
            line += &format!(", {source}");
        }
        if is_texture {
            let (unit, kind) = match self.layout.samplers.len() {
                0 => (0, TextureKind::D2),
                n => self.layout.samplers[self.r.below(n)],
            };
            let target = match kind {
                TextureKind::D1 => "1D",
                TextureKind::D2 => "2D",
                TextureKind::Rectangle => "RECT",
                TextureKind::Cube => "CUBE",
                TextureKind::Volume => "3D",
            };
            let unit = if self.nv { format!("TEX{unit}") } else { format!("texture[{unit}]") };
            line += &format!(", {unit}, {target}");
        }
        line + ";"
    }

    fn outputs(&mut self) {
        let n = self.r.below(self.temps);
        let (color, depth) = if self.nv { ("o[COLR]", "o[DEPR].z") } else { ("result.color", "result.depth.z") };
        let half = self.nv && self.r.one_in(3);
        let line = match half {
            true => format!("MOV{} o[COLH], H{n};", self.r.of(&["", "R", "H", "X", "C"])),
            false => format!("MOV{} {color}, R{n};", if self.nv { self.r.of(&["", "R", "H", "X"]) } else { "" }),
        };
        self.lines.push(line);
        if self.r.one_in(3) {
            let (n, c) = (self.r.below(self.temps), component(self.r));
            self.lines.push(format!("MOV {depth}, R{n}.{c};"));
        }
        if self.nv && self.r.one_in(4) {
            let (condition, color) = (self.condition(), if half { "o[COLH]" } else { color });
            let mask = mask(self.r);
            let source = self.r.below(self.temps);
            self.lines.push(format!("ADDR {color}{mask} ({condition}), R{source}, R0;"));
        }
    }
}

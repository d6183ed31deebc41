//! The request of the page, and the answer.

use crossbar_base::compare::{TargetFormats, TraceSide, first_difference};
use refsim::asm::assemble;
use refsim::check::{Checked, check};
use refsim::device::Profile;
use refsim::exec::{Constants, ResolvedConstants};
use refsim::isa::{Program, Span};
use refsim::machine::{ExecutorKind, FragmentTrace, MachineError};
use refsim::num::{Format, FormatError};
use refsim::texture::TexelFormat;
use serde::{Deserialize, Serialize};

use crate::examples::{EXAMPLES, Example};
use crate::scene::{SIDE, Scene};
use crate::shown::{ShownDifference, ShownTrace};

/// Maximum length of a program, in bytes.
pub(crate) const MAX_TEXT: usize = 1 << 16;
/// Step budget of a fragment, so that the page answers in time.
const STEP_BUDGET: u32 = 10_000;

/// A device, with a register format if it replaces the device's own.
#[derive(Clone, Debug, Deserialize)]
pub struct Device {
    /// Name of a profile.
    pub device: String,
    /// Register format in place of the device's own.
    pub format: Option<String>,
}

/// A program and the requested action.
#[derive(Clone, Debug, Deserialize)]
pub struct Request {
    /// The program.
    pub text: String,
    /// The device that runs it.
    #[serde(flatten)]
    pub device: Device,
    /// A device to compare with.
    pub other: Option<Device>,
    /// Column and row of a pixel to trace.
    pub pixel: Option<[u32; 2]>,
}

/// An error or warning about the program, with its position.
#[derive(Debug, Serialize)]
pub(crate) struct Remark {
    message: String,
    help: String,
    /// Line and column, from 1; 0 if there is no position.
    line: usize,
    column: usize,
    /// Range in the text, in UTF-16 units, as in JavaScript.
    start: usize,
    end: usize,
}

/// Result of drawing with the program on one device.
#[derive(Debug, Serialize)]
struct Drawn {
    format: String,
    /// Red, green and blue per pixel.
    picture: Vec<u8>,
}

#[derive(Debug, Default, Serialize)]
struct Answer {
    side: u32,
    devices: Vec<&'static str>,
    examples: &'static [Example],
    errors: Vec<Remark>,
    warnings: Vec<Remark>,
    drawn: Option<Drawn>,
    other: Option<Drawn>,
    trace: Option<ShownTrace>,
    difference: Option<ShownDifference>,
}

/// Answers a request in JSON with JSON. Errors in the program or in the request are part of the answer.
pub fn answer(request: &str) -> String {
    let mut answer = Answer { side: SIDE, devices: Profile::all_names(), examples: &EXAMPLES, ..Answer::default() };
    match serde_json::from_str::<Request>(request) {
        Ok(request) => {
            if let Err(remarks) = answer.fill(&request) {
                answer.errors.extend(remarks);
            }
        }
        Err(error) => answer.errors.push(Remark::about_nothing(error.to_string(), "send a request as JSON")),
    }
    serde_json::to_string(&answer).unwrap_or_default()
}

impl Remark {
    pub(crate) fn about_nothing(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: help.into(), line: 0, column: 0, start: 0, end: 0 }
    }

    pub(crate) fn new(text: &str, span: Span, message: String, help: String) -> Self {
        let before = |end: u32| text.get(..end as usize).unwrap_or(text);
        let units = |text: &str| text.encode_utf16().count();
        let (start, end) = (before(span.start), before(span.end));
        let line_start = start.rfind('\n').map_or(0, |at| at + 1);
        Self {
            message,
            help,
            line: 1 + start.matches('\n').count(),
            column: 1 + start[line_start..].chars().count(),
            start: units(start),
            end: units(end),
        }
    }
}

impl Device {
    /// The device's profile, with the requested register format and a step budget.
    pub(crate) fn profile(&self) -> Result<Profile, Vec<Remark>> {
        let refused = |error: &dyn std::fmt::Display, help: &str| vec![Remark::about_nothing(error.to_string(), help)];
        let mut profile = Profile::named(&self.device).map_err(|error| refused(&error, "choose another device"))?;
        if let Some(format) = self.format.as_ref().filter(|format| !format.is_empty()) {
            let help = "for example `s3.12`, `fp24` or `e5m10:rtz`";
            let set = format.parse::<Format>().and_then(|format| profile.set_format(format));
            set.map_err(|error: FormatError| refused(&error, help))?;
        }
        profile.limits.set_step_budget(STEP_BUDGET);
        Ok(profile)
    }
}

pub(crate) fn checked(text: &str, program: Program, profile: &Profile) -> Result<Checked<Program>, Vec<Remark>> {
    check(program, profile).map_err(|report| {
        let remark = |violation: &refsim::check::Violation| {
            Remark::new(text, violation.span, violation.message.clone(), violation.help.clone())
        };
        report.violations.iter().map(remark).collect()
    })
}

/// A program on one device.
struct Side {
    profile: Profile,
    program: Checked<Program>,
}

impl Side {
    fn new(text: &str, device: &Device) -> Result<Self, Vec<Remark>> {
        let profile = device.profile()?;
        let program = assemble(text).map_err(|found| {
            let remark =
                |error: &refsim::asm::SyntaxError| Remark::new(text, error.span, error.to_string(), error.help.clone());
            found.errors.iter().map(remark).collect::<Vec<_>>()
        })?;
        Ok(Self { program: checked(text, program, &profile)?, profile })
    }

    fn drawn(&self) -> Result<Drawn, MachineError> {
        let picture = Scene::new(&self.program, &self.profile, ExecutorKind::Batch)?.picture()?;
        Ok(Drawn { format: self.profile.rules.format.to_string(), picture })
    }

    fn trace(&self, pixel: [u32; 2]) -> Result<Vec<FragmentTrace>, MachineError> {
        Scene::new(&self.program, &self.profile, ExecutorKind::Scalar)?.trace(pixel)
    }
}

impl Answer {
    fn fill(&mut self, request: &Request) -> Result<(), Vec<Remark>> {
        let text = request.text.as_str();
        if text.len() > MAX_TEXT {
            let message = format!("expected a program of at most {MAX_TEXT} bytes, found {}", text.len());
            return Err(vec![Remark::about_nothing(message, "use `crossbar run` for longer programs")]);
        }
        let failed =
            |error: MachineError| vec![Remark::about_nothing(error.to_string(), "change the program or the device")];
        let side = Side::new(text, &request.device)?;
        let warning = |warning: &refsim::check::Warning| {
            Remark::new(text, warning.span, warning.message.clone(), warning.help.to_owned())
        };
        self.warnings = side.program.warnings().iter().map(warning).collect();
        self.drawn = Some(side.drawn().map_err(failed)?);
        let other = request.other.as_ref().map(|device| Side::new(text, device)).transpose()?;
        if let Some(other) = &other {
            self.other = Some(other.drawn().map_err(failed)?);
        }
        let Some(pixel) = request.pixel else { return Ok(()) };
        let fragments = side.trace(pixel).map_err(failed)?;
        self.trace = fragments.first().map(|fragment| ShownTrace::new(&side.program, &side.profile, text, fragment));
        if let Some(other) = &other {
            let others = other.trace(pixel).map_err(failed)?;
            self.difference = difference(&side, &fragments, other, &others, text);
        }
        Ok(())
    }
}

fn difference(
    left: &Side,
    fragments: &[FragmentTrace],
    right: &Side,
    others: &[FragmentTrace],
    text: &str,
) -> Option<ShownDifference> {
    let constants =
        [left, right].map(|s| ResolvedConstants::pixel(&s.program, &s.profile.rules, &Constants::default()));
    let side = |side: &'_ Side| side.profile.rules.format;
    let a = TraceSide { program: &left.program, format: side(left), constants: &constants[0], fragments };
    let b = TraceSide { program: &left.program, format: side(right), constants: &constants[1], fragments: others };
    let formats = TargetFormats { targets: &[TexelFormat::Bgra8], depth: None };
    let found = first_difference(&a, &b, &formats)?;
    Some(ShownDifference::new(&left.program, text, &found))
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;

    fn asked(request: &Value) -> Value {
        serde_json::from_str(&answer(&request.to_string())).expect("JSON")
    }

    const MODULATE: &str = "ps_1_4\ntexld r0, t0\nmul r0, r0, v0\n";

    #[test]
    fn a_program_is_drawn_traced_and_compared() {
        let other = json!({ "device": "r300" });
        let found = asked(&json!({ "text": MODULATE, "device": "r200", "other": other, "pixel": [9, 4] }));
        assert_eq!(found["errors"], json!([]), "{found}");
        assert_eq!(found["drawn"]["format"], "s3.12:rdn");
        let picture = found["drawn"]["picture"].as_array().expect("a picture");
        assert_eq!(picture.len(), (3 * SIDE * SIDE) as usize);
        // White texels leave the color unchanged: (s, t, 1 - s) at the center of pixel (9, 1).
        let at = |x: usize, y: usize| &picture[3 * (y * SIDE as usize + x)..][..3];
        assert_eq!(at(9, 1), [json!(76), json!(12), json!(179)], "{:?}", at(9, 1));
        let steps = found["trace"]["steps"].as_array().expect("steps");
        assert_eq!(steps.iter().map(|step| &step["line"]).collect::<Vec<_>>(), [&json!(2), &json!(3)]);
        assert_eq!(steps[0]["written"][0]["name"], "r0.x");
        assert!(found["difference"]["stage"].as_str().is_some_and(|stage| !stage.is_empty()), "{found}");
    }

    #[test]
    fn mistakes_have_their_place() {
        let found = asked(&json!({ "text": "ps_1_4\n; \u{fc}\nmull r0, r0\n", "device": "r200" }));
        let error = &found["errors"][0];
        assert_eq!(
            (&error["line"], &error["column"], &error["start"], &error["end"]),
            (&json!(3), &json!(1), &json!(11), &json!(15)),
            "{error}"
        );
        assert!(found["drawn"].is_null());
        // The program breaks a rule of the card.
        let found = asked(&json!({ "text": "ps_2_0\nmov oC0, c0\n", "device": "r200" }));
        assert_eq!(found["errors"][0]["line"], 1, "{found}");
        for request in [
            json!({ "text": "", "device": "nv99" }),
            json!({ "text": MODULATE, "device": "r200", "format": "s3" }),
            json!({ "text": MODULATE, "device": "r200", "format": "e8m0" }),
        ] {
            assert_eq!(asked(&request)["errors"][0]["line"], 0);
        }
        assert!(answer("no JSON").contains("\"errors\":[{"));
    }

    #[test]
    fn every_language_runs() {
        let mut programs: Vec<(&str, &str)> = EXAMPLES.iter().map(|example| (example.text, example.device)).collect();
        programs.extend([
            ("!!FP1.0\nTEX R0, f[TEX2], TEX0, RECT;\nMULR o[COLR], R0, f[COL0];\nEND\n", "nv35"),
            ("!!ARBfp1.0\nTEX result.color, fragment.texcoord[0], texture[1], 2D;\nEND\n", "r300"),
            ("ps_2_0\ndcl t1\nrsq r0, t1.x\nmov oC0, r0\n", "ideal-fp16"),
        ]);
        for (text, device) in programs {
            let found = asked(&json!({ "text": text, "device": device, "pixel": [3, 3] }));
            assert_eq!(found["errors"], json!([]), "{device}");
            assert!(found["trace"]["steps"].as_array().is_some_and(|steps| !steps.is_empty()), "{device}");
        }
    }

    /// Digests of the answers that `tests/page` expects of the module in a browser. After an intended change, replace
    /// the list by this output.
    #[test]
    fn answers_are_those_of_the_list() {
        let line = |example: &Example| {
            let request = json!({ "text": example.text, "device": example.device, "pixel": [9, 9] });
            format!("{:08x} {}\n", crc32fast::hash(answer(&request.to_string()).as_bytes()), example.title)
        };
        assert_eq!(EXAMPLES.iter().map(line).collect::<String>(), include_str!("../answers.txt"));
    }

    /// A page answers in time: a loop that would run for long ends with an error.
    #[test]
    fn endless_programs_end() {
        let text =
            "ps_2_a\ndefi i0, 255, 0, 0, 0\nmov r0, c0\nrep i0\nrep i0\nadd r0, r0, r0\nendrep\nendrep\nmov oC0, r0\n";
        let found = asked(&json!({ "text": text, "device": "nv35" }));
        assert!(found["errors"][0]["message"].as_str().is_some_and(|text| text.contains("10000")), "{found}");
    }
}

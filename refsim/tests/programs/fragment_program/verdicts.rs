//! Legal and illegal programs of `fixtures/shaders/opengl/verdicts.toml`.

use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Verdicts {
    program: Vec<Verdict>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Verdict {
    body: Option<String>,
    device: Option<String>,
    text: Option<String>,
    expected: String,
    why: String,
}

fn verdict(text: &str, device: &str) -> String {
    let program = match assemble(text) {
        Ok(program) => program,
        Err(found) => return found.errors[0].kind.code(),
    };
    match check(program, &Profile::named(device).unwrap()) {
        Ok(_) => "legal".to_owned(),
        Err(report) => report.violations[0].rule.to_string(),
    }
}

#[test]
fn every_program_gets_its_verdict() {
    let all: Verdicts = toml::from_str(include_str!("../../../../fixtures/shaders/opengl/verdicts.toml")).unwrap();
    let mut wrong = String::new();
    for (number, program) in all.program.iter().enumerate() {
        let text = match (&program.body, &program.text) {
            (Some(body), None) => format!("!!ARBfp1.0\n{body}\nEND\n"),
            (None, Some(text)) => text.clone(),
            _ => panic!("program {number} has either `body` or `text`"),
        };
        let found = verdict(&text, program.device.as_deref().unwrap_or("nv35"));
        if !program.expected.split('|').any(|expected| expected == found) {
            wrong +=
                &format!("{number}: expected {}, since {}: found {found}\n{text}\n", program.expected, program.why);
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    assert!(all.program.len() >= 150, "{} programs", all.program.len());
}

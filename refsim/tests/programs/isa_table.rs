//! Facts about the opcode table and the other types of `refsim::isa`.

use refsim::isa::{DestinationRule, Opcode, OpcodeClass, Spelling, Stage, Version};
use std::collections::BTreeMap;

#[test]
fn a_mnemonic_is_shared_only_by_a_plain_and_a_comparing_form() {
    let mut names: BTreeMap<&str, Vec<bool>> = BTreeMap::new();
    for &opcode in Opcode::ALL {
        names.entry(opcode.info().mnemonic).or_default().push(opcode.info().comparison);
    }
    let shared: Vec<_> = names.iter().filter(|(_, forms)| forms.len() > 1).collect();
    let both = vec![false, true];
    assert_eq!(shared, [(&"break", &both), (&"if", &both)]);
}

#[test]
fn operands_fit_their_class() {
    for &opcode in Opcode::ALL {
        let info = opcode.info();
        for version in Version::ALL {
            let Some(sources) = info.source_count(version) else {
                assert_eq!(info.slot_cost(version), Default::default(), "{opcode:?} {version}");
                continue;
            };
            assert!(sources <= 4, "{opcode:?} {version}");
            match info.class {
                OpcodeClass::Marker => assert_eq!(info.destination, DestinationRule::None),
                OpcodeClass::Flow => assert_eq!(info.destination, DestinationRule::None),
                OpcodeClass::Arithmetic => {
                    assert_eq!(info.destination, DestinationRule::Write);
                    assert!(sources >= 1, "{opcode:?} {version}");
                }
                OpcodeClass::Texture => {
                    assert_eq!(version.stage(), Stage::Pixel, "{opcode:?}");
                    assert_ne!(info.destination, DestinationRule::None);
                    assert!(info.slot_cost(version).texture >= 1, "{opcode:?} {version}");
                }
            }
        }
    }
    let readers = Opcode::ALL.iter().filter(|o| o.info().destination == DestinationRule::Read);
    assert_eq!(readers.collect::<Vec<_>>(), [&Opcode::TexKill]);
}

/// Number of instructions per version in Direct3D's tables.
#[test]
fn versions_have_as_many_operations_as_the_reference_lists() {
    let count = |v| Opcode::ALL.iter().filter(|o| o.info().available(v)).count();
    let counts = Version::ALL.map(|v| (v.token(), count(v)));
    let want = [
        ("ps_1_1", 22),
        ("ps_1_2", 28),
        ("ps_1_3", 29),
        ("ps_1_4", 17),
        ("ps_2_0", 32),
        ("ps_2_a", 49),
        ("ps_2_b", 32),
        ("vs_1_1", 26),
        ("vs_2_0", 45),
    ];
    assert_eq!(counts, want);
}

#[test]
fn fragment_programs_have_the_instructions_of_their_specifications() {
    let names = |version| -> Vec<&str> {
        Spelling::ALL.iter().filter(|s| s.opcode.info().available(version)).map(|s| s.name).collect()
    };
    assert_eq!((names(Version::Fp1_0).len(), names(Version::ArbFp1_0).len()), (45, 33));
    for version in Version::FRAGMENT {
        let spelt = Opcode::ALL.iter().filter(|o| o.info().available(version)).all(|&o| Spelling::of(o).is_some());
        assert!(spelt, "{version}");
    }
    assert!(Spelling::ALL.iter().map(|s| s.name).is_sorted(), "in the order of the names");
}

#[test]
fn slots_of_the_reference_pages() {
    let slots = |o: Opcode, v| {
        let cost = o.info().slot_cost(v);
        (cost.texture, cost.arithmetic)
    };
    for (opcode, version, want) in [
        (Opcode::TexBemL, Version::Ps1_1, (1, 1)),
        (Opcode::Cmp, Version::Ps1_2, (0, 2)),
        (Opcode::Cmp, Version::Ps1_4, (0, 1)),
        (Opcode::Bem, Version::Ps1_4, (0, 2)),
        (Opcode::Phase, Version::Ps1_4, (0, 0)),
        (Opcode::Nop, Version::Ps1_4, (0, 0)),
        (Opcode::Nop, Version::Ps2_0, (0, 1)),
        (Opcode::SinCos, Version::Ps2_0, (0, 8)),
        (Opcode::TexLdB, Version::Ps2_0, (1, 0)),
        (Opcode::TexLdB, Version::Ps2A, (6, 0)),
        (Opcode::TexLdP, Version::Ps2B, (3, 0)),
        (Opcode::TexKill, Version::Ps2A, (2, 0)),
        (Opcode::Frc, Version::Vs1_1, (0, 3)),
        (Opcode::Log, Version::Vs1_1, (0, 10)),
        (Opcode::Lit, Version::Vs2_0, (0, 3)),
    ] {
        assert_eq!(slots(opcode, version), want, "{opcode:?} {version}");
    }
}

#[test]
fn version_tokens_read_back() {
    for version in Version::ALL {
        assert_eq!(version.token().parse(), Ok(version));
        assert_eq!(version.token().to_uppercase().replace('_', ".").parse(), Ok(version));
    }
    assert!("ps_3_0".parse::<Version>().is_err());
    assert!("".parse::<Version>().is_err());
}

//! Sections of a rigid body's report that its parameters hold.

use super::{super::ProgramReport, limits, tables};
use crate::Section;
use files::message::{percent, quantity, significant};
use parameters::Parameters;

/// What the report has of springs, with or without a record.
pub(super) fn sections(p: &Parameters) -> Vec<Section> {
    let mut all = vec![Section {
        id: "table1",
        title: "The springs as in the paper's Table 1".into(),
        text: vec![
            "For one foot; every foot has a vertical and a horizontal unit. In a unit the gap \
                spring k1 stands between the foot and an absorber of mass m2, and the spring k2 \
                and the dashpot c, side by side, between the absorber and the ground. mu = m2/m1 \
                with the structure's mass m1."
                .into(),
            tables::ABSORBER.into(),
        ],
        notes: p.assessment.iter().flat_map(|a| a.design()).flatten().collect(),
        table: Some(tables::springs(p)),
        ..Section::default()
    }];
    all.extend(
        ProgramReport::of_rigid(p)
            .iter()
            .flat_map(|program| [program.section(), program.springs()]),
    );
    if let Some(m) = &p.matched {
        all.push(Section {
            id: "comparison",
            title: format!("The first {} s of the record", significant(m.duration_s, 4)),
            text: p.conditioning.iter().filter_map(limits::conditioning).collect(),
            table: Some(tables::comparison(p)),
            ..Section::default()
        });
    }
    if let (Some(table), Some(accuracy)) = (tables::with_members(p), &p.accuracy_with_members) {
        let until = accuracy.until_s.map_or("its end".into(), |s| quantity(s, "s"));
        all.push(Section {
            id: "comparison-with-members",
            title: "The same with members".into(),
            text: vec![format!(
                "Housner's equation with the torques of tendon and dampers, beside the finite \
                    elements. To {until}: error of the largest displacement {}, of the largest \
                    uplift {}, NRMSE of the history {}.",
                percent(accuracy.displacement),
                percent(accuracy.uplift),
                significant(accuracy.history, 2)
            )],
            table: Some(table),
            ..Section::default()
        });
    }
    if !p.landings.is_empty() {
        let asked = significant(p.restitution(), 4);
        all.push(Section {
            id: "landings",
            title: "Landings without a record".into(),
            text: vec![format!(
                "Released at rest from a share of alpha, landed once, up to the next impact. \
                    Restitution asked for: {asked}. Ringing is a share of the weight."
            )],
            table: Some(tables::landings(p)),
            ..Section::default()
        });
    }
    all
}

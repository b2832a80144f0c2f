//! Springs that stiffen give Housner's history.

use rocking::{housner, motion::nrmse};

use crate::common::{el_centro, paper, plastic, settled};

#[test]
fn stiff_springs_give_housner_s_history_of_el_centro() {
    let (structure, record) = (paper(1e-5), el_centro());
    let body = structure.body::<f64>();
    let rigid = housner::history(&body, record.dt, &record.accel);
    let motion = rigid.motion(&body);
    let mut errors = Vec::new();
    for hz in [80.0, 320.0, 1280.0] {
        let history = settled(&structure, plastic(hz, structure.mass_kg), &record);
        assert_eq!(history.impacts(), rigid.impacts.len(), "{hz} Hz");
        errors.push([nrmse(&history.motion.u, &motion.u), nrmse(&history.motion.v, &motion.v)]);
    }
    let [soft, _, stiff] = errors[..] else { unreachable!() };
    assert!(stiff.iter().all(|e| *e < 3e-3), "{errors:?}");
    // 16 times the frequency, at least 16 times closer
    assert!(stiff[0] < soft[0] / 16.0, "{errors:?}");
}

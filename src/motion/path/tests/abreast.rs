//! Courses side by side against the same ones alone.

use super::*;

#[test]
fn what_comes_of_a_course_does_not_depend_on_its_neighbours() {
    for model in [kuka(), beside()] {
        let rig = rig(&model);
        let mut dice = Dice(17);
        // Straight and turning ones on the branch of the first, some of which it does not carry.
        let mut moves: Vec<(Course, Joints)> = Vec::new();
        let mut first = None;
        for number in 0..60 {
            let turn = if number % 3 == 0 { 0.0 } else { 1.2 };
            let (course, branch, start) = random_move(&mut dice, &rig, rig.axes, 600.0, turn);
            first = first.or(Some(branch));
            moves.push((course, start));
        }
        let branch = first.unwrap();
        let together = prove_all(&rig, &moves, branch, &LEAST);
        assert_eq!(together.len(), moves.len());
        for ((course, start), proof) in moves.iter().zip(&together) {
            assert_eq!(*proof, prove(&rig, course, branch, start, &LEAST));
        }
        assert!(together.iter().any(Result::is_ok) && together.iter().any(Result::is_err));
    }
}

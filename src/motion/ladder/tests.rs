//! The way up against trying all of them.

use super::*;
use proptest::prelude::*;

/// A ladder of given costs. Links from the rungs of each run to those of the next are in `links`, at the run they lead to.
#[derive(Clone, Debug)]
struct Given {
    rungs: Vec<Vec<Cost>>,
    links: Vec<Vec<Vec<Option<Cost>>>>,
    failing: BTreeSet<Link>,
    tested: Vec<Link>,
}

impl Ladder for Given {
    fn runs(&self) -> usize {
        self.rungs.len()
    }

    fn rungs(&self, run: usize) -> &[Cost] {
        &self.rungs[run]
    }

    fn link(&self, run: usize, from: usize, to: usize) -> Option<Cost> {
        self.links[run][from][to]
    }

    fn holds(&mut self, run: usize, from: usize, to: usize) -> bool {
        self.tested.push((run, from, to));
        !self.failing.contains(&(run, from, to))
    }
}

/// What a way costs, links put to the test; nothing for a way that cannot be taken.
fn cost(ladder: &Given, way: &[usize]) -> Option<(f64, u32, f64)> {
    let mut total = (f64::INFINITY, 0, 0.0);
    let mut add = |cost: Cost| {
        total = (
            total.0.min(cost.margin),
            total.1 + cost.changes,
            total.2 + cost.travel,
        );
    };
    for (run, &rung) in way.iter().enumerate() {
        add(ladder.rungs[run][rung]);
        if run > 0 {
            let link = (run, way[run - 1], rung);
            if ladder.failing.contains(&link) {
                return None;
            }
            add(ladder.links[run][way[run - 1]][rung]?);
        }
    }
    Some(total)
}

/// All ways, in order.
fn ways(ladder: &Given) -> Vec<Vec<usize>> {
    ladder.rungs.iter().fold(vec![Vec::new()], |ways, rungs| {
        let longer = |way: &Vec<usize>| {
            let way = way.clone();
            (0..rungs.len()).map(move |rung| [way.clone(), vec![rung]].concat())
        };
        ways.iter().flat_map(longer).collect()
    })
}

/// Few values, so that many ways are equal in their margin or their changes.
fn any_cost() -> impl Strategy<Value = Cost> {
    (0_u8..4, 0_u32..2, 0_u8..5).prop_map(|(margin, changes, travel)| Cost {
        margin: f64::from(margin) / 4.0,
        changes,
        travel: f64::from(travel),
    })
}

fn any_ladder() -> impl Strategy<Value = Given> {
    prop::collection::vec(prop::collection::vec(any_cost(), 0..4), 1..6).prop_flat_map(|rungs| {
        let links: Vec<_> = (0..rungs.len())
            .map(|run| {
                let from = if run == 0 { 0 } else { rungs[run - 1].len() };
                let link = prop::option::weighted(0.8, any_cost());
                let row = prop::collection::vec(link, rungs[run].len());
                prop::collection::vec(row, from)
            })
            .collect();
        let failing = prop::collection::btree_set((1_usize..6, 0_usize..4, 0_usize..4), 0..20);
        (Just(rungs), links, failing).prop_map(|(rungs, links, failing)| Given {
            rungs,
            links,
            failing,
            tested: Vec::new(),
        })
    })
}

proptest! {
    #[test]
    fn no_way_is_better(ladder in any_ladder()) {
        let mut climbed = ladder.clone();
        let found = climb(&mut climbed);
        let best = ways(&ladder)
            .iter()
            .filter_map(|way| cost(&ladder, way))
            .min_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)).then(a.2.total_cmp(&b.2)));
        match (found, best) {
            (Ok(way), best) => prop_assert_eq!(cost(&ladder, &way), best),
            (Err(_), best) => prop_assert_eq!(best, None),
        }
        // A link is put to the test once.
        let tested: BTreeSet<_> = climbed.tested.iter().collect();
        prop_assert_eq!(tested.len(), climbed.tested.len());
    }
}

#[test]
fn where_it_ends_is_reported() {
    let free = Cost {
        margin: 1.0,
        changes: 0,
        travel: 0.0,
    };
    let mut ladder = Given {
        rungs: vec![vec![free], vec![free], Vec::new()],
        links: vec![Vec::new(), vec![vec![Some(free)]], vec![Vec::new()]],
        failing: BTreeSet::new(),
        tested: Vec::new(),
    };
    assert_eq!(climb(&mut ladder), Err(Stuck::At(2)));
    ladder.rungs.pop();
    ladder.failing.insert((1, 0, 0));
    assert_eq!(climb(&mut ladder), Err(Stuck::Refuted(1)));
}

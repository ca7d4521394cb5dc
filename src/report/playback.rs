//! The playback of a report: the blade, the stock and the machine in space, as time passes.
//!
//! What is shown is taken from the finished program, not from the plan: poses op by op ([`timeline`]), times, and the axes
//! that were proven ([`track`]). The viewer (`src/report/assets/player`, WebGL 2, no package of others) replays the cuts on a
//! surface of its own, the one of `src/simulation/surface.rs` over again, and moves the machine by products of matrices
//! ([`vcutc_machine::kinematics::linkage`]). Within an op the motion continues evenly: how controllers speed up and slow down within
//! it is not shown, how long it takes is.

pub mod bodies;
mod document;
pub mod taken;
pub mod timeline;
pub mod track;

use bodies::{Body, bodies};
use taken::Taken;
use timeline::Timeline;
use track::Track;
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{self, Action, Axis, Blade, OperationId, Program, Stock, ToolId};
use vcutc_driver::{Compiled, Finished};
use vcutc_geometry::curve::Point2;
use vcutc_job::PlannedJob;
use vcutc_machine::kinematics::linkage::Linkage;
use vcutc_machine::kinematics::pose::Pose;
use vcutc_motion::rigs::Rigs;
use vcutc_motion::solve::Reached;
use vcutc_process::verdict;

/// Most ops that are played, some 100,000 cuts: pages with more would be too large for browsers.
pub const MOST_OPS: usize = 400_000;

/// All that the viewer needs to know.
#[derive(Clone, Debug, PartialEq)]
pub struct Playback<'a> {
    pub stock: Stock,
    /// Places along y, each with how much higher the section of the work stands there than it is drawn.
    spine: Vec<[f64; 2]>,
    /// The part's contour, from left to right, in W.
    pub part: &'a [Point2],
    /// The blades of the program, of which the first is at hand when it starts.
    pub blades: &'a [Blade],
    /// The ops that change the blade, and the blade that is at hand after each.
    pub changes: Vec<(usize, ToolId)>,
    /// How many operations the program has.
    pub operations: usize,
    /// The operations that clear regions of the plan with a round tool, counted from 1.
    pub pockets: Vec<u16>,
    /// The operations that slit walls of regions, counted from 1.
    pub walls: Vec<u16>,
    /// What slits and discs take, where there are any: of Vs it follows from their poses.
    pub taken: Option<Taken>,
    /// How the blade is held.
    pub orientations: &'a [Orientation],
    /// What happens when.
    pub timeline: Timeline,
    /// The machine, if the job has one.
    pub cell: Option<Cell<'a>>,
}

/// A machine, and where its axes are when.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell<'a> {
    pub axes: &'a [Axis],
    /// How they move it.
    pub linkage: Linkage,
    /// The frame T of each blade, seen from the flange.
    pub blades_in_flange: Vec<Pose>,
    /// The workpiece frame W seen from where the work is mounted.
    pub work_in_mount: Pose,
    pub bodies: Vec<Body>,
    /// Where the axes are.
    pub track: Track,
}

/// Places of a spine that are drawn: more could not be distinguished.
const MOST_PLACES: usize = 40;

/// The spine of a plan's cuts, as it is drawn; level where they are.
fn spine(plan: &PlannedJob) -> Vec<[f64; 2]> {
    let depth = plan.stock.depth.to_mm();
    match plan.surface.as_ref().and_then(|surface| surface.spine()) {
        None => vec![[0.0, 0.0], [depth, 0.0]],
        Some(spine) => {
            let places = spine.knots().len().min(MOST_PLACES) - 1;
            let place = |number: usize| depth * number as f64 / places as f64;
            let places = (0..=places).map(place);
            places.map(|y| [y, spine.rise(y)]).collect()
        }
    }
}

impl<'a> Playback<'a> {
    #[must_use]
    pub fn of(plan: &'a PlannedJob, compiled: &'a Compiled) -> Self {
        let program = compiled.program.verified().program();
        let cell = match &compiled.program {
            Finished::WithoutMachine(_) => None,
            Finished::Reached(reached) => cell(plan, reached),
        };
        Self {
            stock: program.stock,
            spine: spine(plan),
            part: plan.profile.points(),
            blades: &program.blades,
            changes: changes(program),
            operations: program.operations.len(),
            pockets: numbered(compiled.report.cleared.iter().map(|cleared| cleared.operation)),
            walls: numbered(compiled.report.slit.iter().map(|slit| slit.operation)),
            taken: Taken::of(compiled.program.verified(), &verdict::bounds(plan)),
            orientations: &program.orientations,
            timeline: Timeline::of(program, &compiled.op_times),
            cell,
        }
    }
}

/// The numbers of operations, counted from 1.
fn numbered(operations: impl Iterator<Item = OperationId>) -> Vec<u16> {
    operations.map(|operation| operation.0 + 1).collect()
}

fn changes(program: &Program) -> Vec<(usize, ToolId)> {
    let ops = program.ops.iter().enumerate();
    let changes = ops.filter_map(|(op, made)| match made.action {
        Action::ToolChange { tool } => Some((op, tool)),
        _ => None,
    });
    changes.collect()
}

fn cell<'a>(plan: &'a PlannedJob, reached: &'a Reached) -> Option<Cell<'a>> {
    let model = &plan.machine.as_ref()?.model;
    let cell: &ir::Cell = reached.program.program().cell.as_ref()?;
    let program = reached.program.program();
    let rigs = Rigs::of(model, cell, program);
    let rig = rigs.first();
    let linkage = Linkage::from(&model.mechanism);
    let bodies = bodies(&linkage, &model.axes, &corners(plan.stock, &rig.work_in_root));
    Some(Cell {
        axes: &model.axes,
        linkage,
        blades_in_flange: (0..)
            .map(ToolId)
            .take(program.blades.len())
            .map(|tool| rigs.with(tool).flange_in_blade.inverse())
            .collect(),
        work_in_mount: rig.work_in_root,
        bodies,
        track: Track::of(&reached.program, &rigs),
    })
}

/// The corners of the stock, seen from the mount.
fn corners(stock: Stock, work_in_mount: &Pose) -> Vec<Point3> {
    let size = [stock.width, stock.depth, stock.height].map(|length| length.to_mm());
    let corner = |number: usize| {
        let mut at = work_in_mount.position;
        let axes = [
            work_in_mount.rotation.x_axis,
            work_in_mount.rotation.y_axis,
            work_in_mount.rotation.z_axis,
        ];
        for (bit, (axis, length)) in axes.into_iter().zip(size).enumerate() {
            if number >> bit & 1 == 1 {
                at += axis * length;
            }
        }
        Point3::new(at.x, at.y, at.z)
    };
    (0..8).map(corner).collect()
}

/// The elements of a page that play a compiled job: canvas, controls, style, script and data. They use nothing of the page
/// and nothing of the network, and there may be one of them in a page.
#[must_use]
pub fn section(plan: &PlannedJob, compiled: &Compiled) -> String {
    let program = compiled.program.verified().program();
    let ops = program.ops.len();
    if ops > MOST_OPS {
        return format!(
            "<p class=\"vcut-playback-absent\">The program has {ops} operations, too many to be played in a page (at most \
             {MOST_OPS}).</p>\n"
        );
    }
    [
        "<style>\n",
        include_str!("assets/player/player.css"),
        "</style>\n",
        include_str!("assets/player/player.html"),
        "<script type=\"application/json\" id=\"vcut-playback-data\">",
        &document::text(&Playback::of(plan, compiled)),
        "</script>\n<script>",
        SCRIPT,
        "</script>\n",
    ]
    .concat()
}

/// The viewer, file by file, as one script: what stands between its tags, to the byte.
pub const SCRIPT: &str = concat!(
    "\n(() => {\n\"use strict\";\n",
    include_str!("assets/player/surface.js"),
    include_str!("assets/player/matrix.js"),
    include_str!("assets/player/bytes.js"),
    include_str!("assets/player/data.js"),
    include_str!("assets/player/machine.js"),
    include_str!("assets/player/timeline.js"),
    include_str!("assets/player/ground.js"),
    include_str!("assets/player/workpiece.js"),
    include_str!("assets/player/triangles.js"),
    include_str!("assets/player/meshes.js"),
    include_str!("assets/player/canvas.js"),
    include_str!("assets/player/camera.js"),
    include_str!("assets/player/pointers.js"),
    include_str!("assets/player/scene.js"),
    include_str!("assets/player/controls.js"),
    include_str!("assets/player/start.js"),
    "})();\n",
);

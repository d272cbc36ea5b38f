//! The shapes of the floor, the walls, the people and the robot's parts for rapier.

use crate::body::BodyPoses;
use crate::math::{Pose, Vector, vector};
use crate::model::BodyModel;
use crate::room::{HALF_M, HEAD_M, ObstacleKind, PersonKind, WAIST_M};
use crate::table::{BodyPart, Primitive};
use rapier3d::prelude::{ColliderBuilder, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle};

/// The groups that meet each other: the robot's parts meet things, never each other.
pub(crate) mod group {
    use rapier3d::prelude::{Group, InteractionGroups, InteractionTestMode};

    /// All groups.
    pub(crate) const ALL: Group = Group::ALL;
    /// The robot's parts but the head.
    const ROBOT: Group = Group::GROUP_1;
    /// The robot's head.
    pub(crate) const HEAD: Group = Group::GROUP_2;
    /// Everything else.
    pub(crate) const THING: Group = Group::GROUP_3;

    /// Groups of a part of the robot.
    pub(crate) fn robot(head: bool) -> InteractionGroups {
        let member = if head { HEAD } else { ROBOT };
        InteractionGroups::new(member, ALL & !(ROBOT | HEAD), InteractionTestMode::And)
    }

    /// Groups of a thing in the room.
    pub(crate) fn things() -> InteractionGroups {
        InteractionGroups::new(THING, ALL, InteractionTestMode::And)
    }
}

/// Half the thickness of floor and walls in metres.
const THICK_M: f32 = 0.05;
/// Height of the walls in metres.
const WALL_M: f32 = 3.0;

/// Adds the floor and four walls.
pub(crate) fn add_room(physics: &mut PhysicsWorld) {
    let (out, middle) = (HALF_M + 0.1 + THICK_M, WALL_M / 2.0);
    let boxes = [
        (Vector::new(0.0, 0.0, -THICK_M), Vector::new(out, out, THICK_M)),
        (Vector::new(out, 0.0, middle), Vector::new(THICK_M, out, middle)),
        (Vector::new(-out, 0.0, middle), Vector::new(THICK_M, out, middle)),
        (Vector::new(0.0, out, middle), Vector::new(out, THICK_M, middle)),
        (Vector::new(0.0, -out, middle), Vector::new(out, THICK_M, middle)),
    ];
    for (at, half) in boxes {
        let shape = ColliderBuilder::cuboid(half.x, half.y, half.z).collision_groups(group::things());
        physics.insert(RigidBodyBuilder::fixed().translation(at), shape.restitution(0.3));
    }
}

/// Adds the parts of the robot that have shapes; each with its link.
pub(crate) fn add_parts(
    physics: &mut PhysicsWorld,
    model: &BodyModel,
    robot: &BodyPoses,
) -> Vec<(usize, RigidBodyHandle)> {
    let with_shapes = model.links.iter().enumerate().filter(|(_, link)| !link.shapes.is_empty());
    with_shapes.map(|(index, link)| (index, add_part(physics, link, robot.links()[index]))).collect()
}

fn add_part(physics: &mut PhysicsWorld, link: &BodyPart, at: Pose) -> RigidBodyHandle {
    let body = physics.insert_body(RigidBodyBuilder::kinematic_position_based().pose(at));
    for shape in &link.shapes {
        physics.insert_collider(collider(shape).collision_groups(group::robot(link.name == "Head")), Some(body));
    }
    body
}

fn collider(shape: &Primitive) -> ColliderBuilder {
    match shape {
        Primitive::Box { at, half } => ColliderBuilder::cuboid(half[0], half[1], half[2]).translation(vector(*at)),
        Primitive::Sphere { at, r } => ColliderBuilder::ball(*r).translation(vector(*at)),
        Primitive::Capsule { a, b, r } => ColliderBuilder::capsule_from_endpoints(vector(*a), vector(*b), *r),
    }
}

/// Adds a person: a capsule and a head, outside the room at first.
pub(crate) fn add_person(physics: &mut PhysicsWorld, kind: &PersonKind) -> RigidBodyHandle {
    let body = RigidBodyBuilder::kinematic_position_based().pose(Pose::translation(kind.at[0], kind.at[1], 0.0));
    let body = physics.insert_body(body.enabled(false));
    let (low, high) = (Vector::Z * WAIST_M, Vector::Z * (kind.height - 2.0 * HEAD_M - WAIST_M));
    let waist = ColliderBuilder::capsule_from_endpoints(low, high, WAIST_M);
    let head = ColliderBuilder::ball(HEAD_M).translation(Vector::Z * (kind.height - HEAD_M));
    physics.insert_collider(waist.collision_groups(group::things()), Some(body));
    physics.insert_collider(head.collision_groups(group::things()), Some(body));
    body
}

/// Adds an obstacle, outside the room at first.
pub(crate) fn add_obstacle(physics: &mut PhysicsWorld, kind: &ObstacleKind) -> RigidBodyHandle {
    let half = kind.size.map(|size| size / 2.0);
    let body = RigidBodyBuilder::kinematic_position_based().pose(Pose::translation(kind.at[0], kind.at[1], half[2]));
    let shape = ColliderBuilder::cuboid(half[0], half[1], half[2]).collision_groups(group::things());
    physics.insert(body.enabled(false), shape).0
}

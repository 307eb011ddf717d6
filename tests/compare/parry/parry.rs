// SPDX-License-Identifier: MIT
//! parry behind the functions that peer.h asks for: bodies, and three questions about two of them.

use std::ffi::{c_int, c_void};

/// As peer_set of peer.h.
#[repr(C)]
pub struct Set {
    core: c_int,
    count: c_int,
    v: *const f64,
    size: [f64; 3],
    posed: c_int,
    m: [f64; 9],
    p: [f64; 3],
    radius: f64,
}

/// The cores of peer.h that have a name of their own here.
const POINTS: c_int = 0;
const BOX: c_int = 1;
const SEGMENT: c_int = 2;
const CYLINDER: c_int = 3;
const CONE: c_int = 4;
const ORIGIN: c_int = 6;

/// As peer_answer of peer.h.
#[repr(C)]
pub struct Answer {
    meet: c_int,
    distance: f64,
    depth: f64,
    normal: [f64; 3],
    bracket: [f64; 2],
    supports: f64,
}

/// One of parry's crates. The functions of C are told apart by their prefix; what depends on the dimension is given.
macro_rules! space {
    ($parry:ident, $make:ident, $discard:ident, $distance:ident, $intersect:ident, $penetration:ident,
     $($own:item)*) => {
        mod $parry {
            use crate::*;
            use ::$parry::math::*;
            use ::$parry::query::gjk::{GJKResult, VoronoiSimplex};
            use ::$parry::query::{self, details::*};
            use ::$parry::shape::{Cuboid, RoundCuboid, SharedShape, SupportMap};
            use std::slice::from_raw_parts;

            pub struct Body {
                shape: SharedShape,
                pose: Pose,
            }

            fn reals(x: &[f64]) -> Vec<Real> {
                x.iter().map(|&x| x as Real).collect()
            }

            fn vector(x: &[f64]) -> Vector {
                let mut v = Vector::ZERO;
                for i in 0..DIM {
                    v[i] = x[i] as Real;
                }
                v
            }

            $($own)*

            /// Of no points, or of a hull that is flat, none.
            fn shape(core: c_int, points: &[Vector], size: &[f64], radius: Real) -> Option<SharedShape> {
                match (core, points) {
                    (BOX, _) if radius > 0.0 => Some(SharedShape::new(RoundCuboid {
                        inner_shape: Cuboid::new(vector(size)),
                        border_radius: radius,
                    })),
                    (BOX, _) => Some(SharedShape::new(Cuboid::new(vector(size)))),
                    (ORIGIN, _) => Some(SharedShape::ball(radius)),
                    (SEGMENT, &[a, b]) if radius > 0.0 => Some(SharedShape::capsule(a, b, radius)),
                    (SEGMENT, &[a, b]) => Some(SharedShape::segment(a, b)),
                    (POINTS, _) if radius > 0.0 => SharedShape::round_convex_hull(points, radius),
                    (POINTS, _) => SharedShape::convex_hull(points),
                    _ => solid(core, size),
                }
            }

            #[no_mangle]
            pub unsafe extern "C" fn $make(set: &Set) -> *mut Body {
                let numbers = if set.count > 0 { from_raw_parts(set.v, set.count as usize * DIM) } else { &[] };
                let points: Vec<Vector> = numbers.chunks(DIM).map(vector).collect();
                let mut pose = Pose::IDENTITY;
                if set.posed != 0 {
                    pose = Pose::from_parts(vector(&set.p), turn(&reals(&set.m)));
                }
                if set.core == CYLINDER || set.core == CONE {
                    pose = pose * last_axis();
                }
                match shape(set.core, &points, &set.size, set.radius as Real) {
                    Some(shape) => Box::into_raw(Box::new(Body { shape, pose })),
                    None => std::ptr::null_mut(),
                }
            }

            #[no_mangle]
            pub unsafe extern "C" fn $discard(body: *mut Body) {
                drop(Box::from_raw(body));
            }

            /// What is kept of a pair: the direction to begin with, in the frame of the first; at first 0.
            type Memory = [f64; 3];

            fn spelled(x: Vector) -> [f64; 3] {
                std::array::from_fn(|i| if i < DIM { x[i] as f64 } else { 0.0 })
            }

            /// What a query of its own takes that begins with a direction.
            struct Begin<'a> {
                pose: Pose,
                x: &'a dyn SupportMap,
                y: &'a dyn SupportMap,
                dir: Option<Vector>,
            }

            fn begin<'a>(a: &'a Body, b: &'a Body, memory: &Memory) -> Option<Begin<'a>> {
                let dir = vector(memory);
                Some(Begin {
                    pose: a.pose.inv_mul(&b.pose),
                    x: a.shape.as_support_map()?,
                    y: b.shape.as_support_map()?,
                    dir: (dir != Vector::ZERO).then_some(dir),
                })
            }

            fn warm_distance(a: &Body, b: &Body, memory: &mut Memory) -> Option<Real> {
                let Begin { pose, x, y, dir } = begin(a, b, memory)?;
                let simplex = &mut VoronoiSimplex::new();
                match closest_points_support_map_support_map_with_params(&pose, x, y, Real::MAX, simplex, dir) {
                    GJKResult::ClosestPoints(p, q, dir) => {
                        *memory = spelled(dir);
                        Some((p - q).length())
                    }
                    GJKResult::Intersection => Some(0.0),
                    _ => None,
                }
            }

            fn warm_intersect(a: &Body, b: &Body, memory: &mut Memory) -> Option<bool> {
                let Begin { pose, x, y, dir } = begin(a, b, memory)?;
                let simplex = &mut VoronoiSimplex::new();
                let (meet, dir) = intersection_test_support_map_support_map_with_params(&pose, x, y, simplex, dir);
                *memory = spelled(dir);
                Some(meet)
            }

            /// Not 0: it has no answer; so do the others.
            #[no_mangle]
            pub extern "C" fn $distance(
                _: *const c_void,
                a: &Body,
                b: &Body,
                memory: Option<&mut Memory>,
                out: &mut Answer,
            ) -> c_int {
                let found = match memory {
                    None => query::distance(&a.pose, &*a.shape, &b.pose, &*b.shape).ok().map(|d| d.distance),
                    Some(memory) => warm_distance(a, b, memory),
                };
                let Some(distance) = found else { return 1 };
                out.distance = distance as f64;
                out.meet = (distance <= 0.0) as c_int;
                0
            }

            #[no_mangle]
            pub extern "C" fn $intersect(
                _: *const c_void,
                a: &Body,
                b: &Body,
                memory: Option<&mut Memory>,
                out: &mut Answer,
            ) -> c_int {
                let found = match memory {
                    None => {
                        let found = query::intersection_test(&a.pose, &*a.shape, &b.pose, &*b.shape);
                        found.ok().map(|i| i.intersecting)
                    }
                    Some(memory) => warm_intersect(a, b, memory),
                };
                let Some(meet) = found else { return 1 };
                out.meet = meet as c_int;
                0
            }

            #[no_mangle]
            pub extern "C" fn $penetration(
                _: *const c_void,
                a: &Body,
                b: &Body,
                _: *mut c_void,
                out: &mut Answer,
            ) -> c_int {
                let Ok(found) = query::contact(&a.pose, &*a.shape, &b.pose, &*b.shape, 0.0) else { return 1 };
                out.meet = found.is_some() as c_int;
                if let Some(contact) = found {
                    out.depth = -contact.dist as f64;
                    out.normal = spelled(contact.normal1);
                }
                0
            }
        }
    };
}

space! {
    parry2d, parry2d_make, parry2d_discard, parry2d_distance, parry2d_intersect, parry2d_penetration,

    fn turn(matrix: &[Real]) -> Rotation {
        Rotation::from_mat(Matrix::from_cols_slice(matrix).transpose())
    }

    fn last_axis() -> Rotation {
        Rotation::IDENTITY
    }

    fn solid(_: c_int, _: &[f64]) -> Option<SharedShape> {
        None
    }
}

macro_rules! space_of_3 {
    ($($name:ident),*) => {
        space! {
            $($name),*,

            fn turn(matrix: &[Real]) -> Rotation {
                Rotation::from_mat3(&Matrix::from_cols_slice(matrix).transpose())
            }

            /// Solids of revolution stand along the second.
            fn last_axis() -> Rotation {
                Rotation::from_rotation_x(std::f64::consts::FRAC_PI_2 as Real)
            }

            fn solid(core: c_int, size: &[f64]) -> Option<SharedShape> {
                let (radius, half) = (size[0] as Real, size[1] as Real);
                match core {
                    CYLINDER => Some(SharedShape::cylinder(half, radius)),
                    CONE => Some(SharedShape::cone(half, radius)),
                    _ => None,
                }
            }
        }
    };
}
space_of_3!(
    parry3d,
    parry3d_make,
    parry3d_discard,
    parry3d_distance,
    parry3d_intersect,
    parry3d_penetration
);
space_of_3!(
    parry3d_f64,
    parry3d_f64_make,
    parry3d_f64_discard,
    parry3d_f64_distance,
    parry3d_f64_intersect,
    parry3d_f64_penetration
);

"""Where a straight line meets a thing first: (metres, the way the surface there looks), or nothing."""

import math


def sphere(eye, way, at, radius):
    to = [a - b for a, b in zip(at, eye)]
    along = sum(a * b for a, b in zip(to, way))
    beside = sum(part * part for part in to) - along * along
    if along < 0 or beside > radius * radius:
        return None
    far = max(along - math.sqrt(radius * radius - beside), 0.0)
    return far, tuple((e + w * far - a) / radius for e, w, a in zip(eye, way, at))


def pillar(eye, way, at, radius, height):
    """A cylinder that stands on the floor."""
    to, level = (at[0] - eye[0], at[1] - eye[1]), math.hypot(way[0], way[1])
    if level < 1e-9:
        return None
    side = (way[0] / level, way[1] / level)
    along = to[0] * side[0] + to[1] * side[1]
    beside = to[0] ** 2 + to[1] ** 2 - along ** 2
    if along < 0 or beside > radius * radius:
        return None
    far = max(along - math.sqrt(radius * radius - beside), 0.0) / level
    up = eye[2] + way[2] * far
    if 0 <= up <= height:
        return far, ((eye[0] + way[0] * far - at[0]) / radius, (eye[1] + way[1] * far - at[1]) / radius, 0.0)
    # Perhaps it comes down on its top, before it leaves the other side.
    if up > height and way[2] < 0:
        far = (height - eye[2]) / way[2]
        if math.hypot(eye[0] + way[0] * far - at[0], eye[1] + way[1] * far - at[1]) <= radius:
            return far, (0.0, 0.0, 1.0)
    return None


def box(eye, way, low, high):
    """A box whose sides are along the walls."""
    near, far, normal = -math.inf, math.inf, (0.0, 0.0, 0.0)
    for axis in range(3):
        if abs(way[axis]) < 1e-12:
            if not low[axis] <= eye[axis] <= high[axis]:
                return None
            continue
        one, other = sorted(((low[axis] - eye[axis]) / way[axis], (high[axis] - eye[axis]) / way[axis]))
        if one > near:
            near, normal = one, tuple(-math.copysign(1.0, way[axis]) if i == axis else 0.0 for i in range(3))
        far = min(far, other)
    return (near, normal) if 0 <= near <= far else None

"""A second decoder of the Yamabiko code, written from docs/SPEC.md alone: exact, not fast.

decode(code, room) gives a Map or raises Refused; numbers in the comments are the sections of that
page. compact_profile.py reads 1.3.
All numbers are whole; plan positions and heights are q8.
"""

import math
from fractions import Fraction

import compact_profile
from refusals import Refused, refuse_if

HIGHEST = 131072


# --- 1. The code ----------------------------------------------------------------------------------


class Bytes:
    """A code's bytes, and its bits, from the front."""

    def __init__(self, code):
        self.code = code
        self.at = 0

    def number(self, count):
        refuse_if(self.at + count > len(self.code), "truncated")
        self.at += count
        return int.from_bytes(self.code[self.at - count : self.at], "big")

    def bits(self, held, count):
        """`count` bits; `held` is [value, bits] of what is left of the last byte."""
        while held[1] < count:
            held[0] = held[0] << 8 | self.number(1)
            held[1] += 8
        held[1] -= count
        value = held[0] >> held[1]
        held[0] &= (1 << held[1]) - 1
        return value


class Contour:
    def __init__(self, first, count, height):
        self.first, self.count, self.height = first, count, height
        self.open = False

    def points(self):
        return range(self.first, self.first + self.count)

    def segments(self):
        """Pairs of vertices; a spot height has none."""
        points = list(self.points())
        return list(zip(points, points[1:] + ([] if self.open or self.count == 1 else points[:1])))


class Plan:
    """What the bytes say: header, contours and points (x, y in steps, height coded)."""


def crc8(code):
    crc = 0
    for byte in code:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ (0x107 if crc & 0x80 else 0)) & 0x1FF
    return crc


def read_header(read):
    """1.1"""
    plan = Plan()
    flags, contours, plan.most_vertices, plan.east, plan.north = (read.number(1) for _ in range(5))
    cell, unit, base, plan.seed, plan.gain = (read.number(n) for n in (2, 2, 2, 1, 1))
    refuse_if(flags & 8 or plan.most_vertices < 4 or plan.east == 0 or plan.north == 0)
    plan.cell, plan.unit = unit_64th(cell), unit_64th(unit)
    plan.base = (base ^ 0x8000) - 0x8000
    plan.smooth = not flags & 4
    plan.shift = flags & 3
    plan.corner = [height_q8(plan, read.number(2)) if flags & 0x80 >> k else None for k in range(4)]
    plan.frame = None if flags & 0xF0 else height_q8(plan, read.number(2))
    plan.counts = []
    for _ in range(contours):
        plan.counts.append(read.number(1))
        refuse_if(plan.counts[-1] == 0 or sum(plan.counts) > plan.most_vertices)
    return plan


def unit_64th(coded):
    refuse_if(coded & 0xFFF == 0)
    return (coded & 0xFFF) << (coded >> 12)


def height_q8(plan, coded):
    """2.1"""
    z = (coded * plan.unit * 256 + plan.cell // 2) // plan.cell
    refuse_if(z > HIGHEST)
    return z


def read_body(read, plan):
    """1.2"""
    held = [0, 0]
    plan.hurst = 256 - read.bits(held, 8)
    plan.points, plan.contours = [], []
    for count in plan.counts:
        z = height_q8(plan, read.bits(held, 16))
        plan.contours.append(Contour(len(plan.points), count, z))
        for k in range(count):
            if k == 0:
                x, y = read.bits(held, 8), read.bits(held, 8)
            else:
                x += ((read.bits(held, 6) ^ 32) - 32) << plan.shift
                y += ((read.bits(held, 6) ^ 32) - 32) << plan.shift
            refuse_if(not (0 <= x <= plan.east and 0 <= y <= plan.north))
            plan.points.append((x, y))
    refuse_if(held[0] != 0)


def read_compact(read, room):
    """1.3"""
    plan = Plan()
    plan.points, plan.contours = [], []
    sections = compact_profile.read_relief(read, plan, room)
    for line, z in plan.lines:
        plan.contours.append(Contour(len(plan.points), len(line), z))
        plan.points += line
    if sections:
        skip_sections(read)
    return plan


def skip_sections(read):
    """1.4"""
    last = False
    while not last:
        head = read.number(1)
        last = head & 0x80
        size = head & 15
        if size == 15:
            size = read.number(2)
        read.number(size)


def read_code(read, room):
    profile = read.number(1)
    refuse_if(profile not in (0x20, 0x21), "version")
    if profile == 0x21:
        plan = read_compact(read, room)
    else:
        plan = read_header(read)
        read_body(read, plan)
    read.number(1)
    refuse_if(crc8(read.code[: read.at]) != 0)
    return plan


def on_frame(plan, place):
    return place[0] in (0, plan.east) or place[1] in (0, plan.north)


def turn(a, b, c):
    """Twice the area of the triangle abc: above 0 if it runs counter-clockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def between(a, b, p):
    """Does p, on the line through a and b, lie strictly between them?"""
    return (a[0] - p[0]) * (b[0] - p[0]) + (a[1] - p[1]) * (b[1] - p[1]) < 0


def cross(a, b, c, d):
    """Do the open segments ab and cd meet in one point?"""
    c_side, d_side = turn(a, b, c), turn(a, b, d)
    if not (c_side < 0 < d_side or d_side < 0 < c_side):
        return False
    a_side, b_side = turn(c, d, a), turn(c, d, b)
    return a_side < 0 < b_side or b_side < 0 < a_side


def check_contours(plan):
    """1.6"""
    points = plan.points
    refuse_if(len(set(points)) < len(points))
    ends = set()
    for contour in plan.contours:
        first, last = points[contour.first], points[contour.points()[-1]]
        contour.open = contour.count > 1 and on_frame(plan, first) and on_frame(plan, last)
        refuse_if(contour.count == 2 and not contour.open)
        if contour.open:
            ends |= {first, last}
            side = any(first[k] == last[k] and first[k] in (0, (plan.east, plan.north)[k])
                       for k in (0, 1))
            refuse_if(contour.count == 2 and side)
    refuse_if(any(on_frame(plan, p) and p not in ends for p in points))
    segments = [(points[a], points[b]) for c in plan.contours for a, b in c.segments()]
    for i, (a, b) in enumerate(segments):
        refuse_if(any(turn(a, b, p) == 0 and between(a, b, p) for p in points))
        refuse_if(any(cross(a, b, *other) for other in segments[:i]))
    for k, place in enumerate(corners(plan)):
        refuse_if(place in ends and plan.corner[k] is not None)


def corners(plan):
    """SW SE NE NW"""
    return [(0, 0), (plan.east, 0), (plan.east, plan.north), (0, plan.north)]


# --- 2.1, 2.2 Vertices and triangles --------------------------------------------------------------


def length(dx, dy):
    """3.1: L̂"""
    dx, dy = abs(dx), abs(dy)
    return max(dx, dy) + 3 * min(dx, dy) // 8


def quotient(a, b):
    """Rounded towards zero."""
    return a // b if (a < 0) == (b < 0) else -(-a // b)


def key(a, b):
    return (a, b) if a < b else (b, a)


class Mesh:
    """apex[a, b] is the third vertex of the triangle on the left of the edge from a to b."""

    def __init__(self, most):
        self.place, self.z, self.most = [], [], most
        self.apex = {}
        self.marked = set()

    def add(self, place, z):
        refuse_if(len(self.place) == self.most, "limit")
        self.place.append(place)
        self.z.append(z)
        return len(self.place) - 1

    def length(self, a, b):
        (xa, ya), (xb, yb) = self.place[a], self.place[b]
        return length(xa - xb, ya - yb)

    def set(self, a, b, c):
        self.apex[a, b], self.apex[b, c], self.apex[c, a] = c, a, b

    def triangles(self):
        return [(a, b, c) for (a, b), c in self.apex.items() if a < b and a < c]

    def free(self, a, b):
        return key(a, b) not in self.marked

    def inner(self, a, b):
        return (a, b) in self.apex and (b, a) in self.apex

    def edges(self):
        """Each edge once, the lower number first, in order."""
        return sorted({key(a, b) for a, b in self.apex})

    def round(self, v):
        """The vertices that v has an edge to."""
        found = set()
        for (a, b), c in self.apex.items():
            if a == v:
                found |= {b, c}
        return found

    def split(self, a, b, v):
        """Cuts the triangles at an edge in two, at v."""
        for p, q in ((a, b), (b, a)):
            c = self.apex.pop((p, q), None)
            if c is not None:
                self.set(p, v, c)
                self.set(v, q, c)

    def find(self, place):
        """The triangle that holds a place: its corners and the turns at its edges."""
        at = self.place
        for a, b, c in self.triangles():
            sides = turn(at[a], at[b], place), turn(at[b], at[c], place), turn(at[c], at[a], place)
            if min(sides) >= 0:
                return (a, b, c), sides
        raise AssertionError("outside of the frame")

    def include(self, v):
        """Cuts the triangle, or the two at an edge, that hold the place of the vertex v."""
        (a, b, c), sides = self.find(self.place[v])
        for edge, side in zip(((a, b), (b, c), (c, a)), sides):
            if side == 0:
                return self.split(*edge, v)
        self.set(a, b, v)
        self.set(b, c, v)
        self.set(c, a, v)

    def flip(self, a, b):
        c, d = self.apex.pop((a, b)), self.apex.pop((b, a))
        self.set(c, a, d)
        self.set(d, b, c)
        return c, d

    def force(self, a, b):
        """Makes an edge of the segment ab, which meets no vertex, and marks it."""
        at = self.place
        self.marked.add(key(a, b))
        if (a, b) in self.apex or (b, a) in self.apex:
            return
        queue = [e for e in self.edges() if cross(at[a], at[b], at[e[0]], at[e[1]])]
        while queue:
            p, q = queue.pop(0)
            r, s = self.apex[p, q], self.apex[q, p]
            if cross(at[p], at[q], at[r], at[s]):
                p, q = self.flip(p, q)
            if cross(at[a], at[b], at[p], at[q]):
                queue.append((p, q))

    def make_delaunay(self):
        """2.2"""
        stack = [e for e in self.edges() if self.inner(*e) and self.free(*e)]
        while stack:
            a, b = stack.pop()
            if not self.inner(a, b) or not self.free(a, b):
                continue
            c, d = self.apex[a, b], self.apex[b, a]
            inside = self.in_circle(a, b, c, d)
            if inside > 0 or (inside == 0 and min(c, d) < min(a, b)):
                self.flip(a, b)
                stack += [(a, c), (c, b), (b, d), (d, a)]

    def in_circle(self, a, b, c, d):
        """Above 0 if d lies inside the circle through a, b and c."""
        x, y = self.place[d]
        (ax, ay), (bx, by), (cx, cy) = ((p - x, q - y) for p, q in
                                        (self.place[a], self.place[b], self.place[c]))
        return ((ax * ax + ay * ay) * (bx * cy - cx * by)
                - (bx * bx + by * by) * (ax * cy - cx * ay)
                + (cx * cx + cy * cy) * (ax * by - bx * ay))

    def sees(self, a, b):
        """2.3"""
        p, q = self.place[a], self.place[b]
        return (not any(turn(p, q, r) == 0 and between(p, q, r) for r in self.place)
                and not any(cross(p, q, self.place[c], self.place[d]) for c, d in self.marked))


def corner_heights(plan):
    """2.1: the heights of the corners at which no line ends, by their numbers."""
    east, north = plan.east, plan.north
    round_trip = 2 * (east + north)

    def way(x, y):
        """Along the frame, from the south-west corner counter-clockwise."""
        if y == 0:
            return x
        if x == east:
            return east + y
        return 2 * east + north - x if y == north else round_trip - y

    known = {}
    for contour in plan.contours:
        if contour.open:
            for v in (contour.first, contour.points()[-1]):
                known[way(*plan.points[v])] = contour.height
    ways = [way(*place) for place in corners(plan)]
    free = [k for k in range(4) if ways[k] not in known]
    known.update({ways[k]: plan.corner[k] for k in free if plan.corner[k] is not None})
    heights = {}
    for k in free:
        if plan.corner[k] is not None:
            heights[k] = plan.corner[k]
        elif not known:
            heights[k] = plan.frame if plan.frame is not None else 0
        else:
            a, z_a = min(((ways[k] - w) % round_trip, z) for w, z in known.items())
            b, z_b = min(((w - ways[k]) % round_trip, z) for w, z in known.items())
            heights[k] = (z_a * b + z_b * a + (a + b) // 2) // (a + b)
    return heights


def triangulate(plan):
    """2.1 and 2.2: the mesh before the rules."""
    heights = corner_heights(plan)
    refuse_if(len(plan.points) + len(heights) > plan.most_vertices)
    mesh = Mesh(plan.most_vertices)
    for contour in plan.contours:
        for v in contour.points():
            x, y = plan.points[v]
            mesh.add((x * 256, y * 256), contour.height)
    for k, z in heights.items():
        x, y = corners(plan)[k]
        mesh.add((x * 256, y * 256), z)
    mesh.points, mesh.coded = len(plan.points), len(mesh.place)
    mesh.contours = list(plan.contours)
    mesh.corners = [mesh.place.index((x * 256, y * 256)) for x, y in corners(plan)]
    sw, se, ne, nw = mesh.corners
    mesh.set(sw, se, ne)
    mesh.set(sw, ne, nw)
    for v in range(len(mesh.place)):
        if v not in mesh.corners:
            mesh.include(v)
    mesh.make_delaunay()
    for contour in mesh.contours:
        for a, b in contour.segments():
            mesh.force(a, b)
    mesh.make_delaunay()
    return mesh


# --- 2.3 Regions ----------------------------------------------------------------------------------


class Region:
    def __init__(self, mesh, seed, segments):
        """seed: an edge with a triangle of the region on its left."""
        self.edges, todo = set(), [seed]
        while todo:
            a, b = todo.pop()
            if (a, b) in self.edges or (a, b) not in mesh.apex:
                continue
            c = mesh.apex[a, b]
            self.edges |= {(a, b), (b, c), (c, a)}
            todo += [(q, p) for p, q in ((a, b), (b, c), (c, a)) if key(p, q) not in segments]
        self.vertices = sorted({a for a, _ in self.edges})
        self.sides = []  # (line, side) in code order; side 0 is the line's left one
        self.across = {}  # line: the region beyond
        self.spots = []

    def lines(self):
        return [line for line, _ in self.sides]

    def free_edges(self, mesh):
        """Within the region, not on the frame, in order."""
        return sorted((a, b) for a, b in self.edges
                      if a < b and mesh.free(a, b) and mesh.inner(a, b))


def find_regions(mesh):
    """In their order, each with its lines and the spot heights in it (2.3)."""
    segments = {key(a, b) for contour in mesh.contours for a, b in contour.segments()}
    regions = []

    def region_of(seed):
        region = next((r for r in regions if seed in r.edges), None)
        if region is None:
            region = Region(mesh, seed, segments)
            regions.append(region)
        return region

    for contour in mesh.contours:
        if contour.count == 1:
            seed = next(e for e in mesh.apex if e[0] == contour.first)
            region_of(seed).spots.append(contour.first)
            continue
        a, b = contour.segments()[0]
        left, right = region_of((a, b)), region_of((b, a))
        left.sides.append((contour, 0))
        right.sides.append((contour, 1))
        left.across[contour], right.across[contour] = right, left
    return regions


# --- 2.4 Summits ----------------------------------------------------------------------------------


def rise_of(mesh, region):
    h = mesh.z[region.vertices[0]]
    across = weight = balance = area_beyond = around = 0
    for line, side in region.sides:
        for a, b in line.segments():
            if side:
                a, b = b, a
            long = mesh.length(a, b)
            around += long
            beyond = mesh.apex[b, a]
            u = h - mesh.z[beyond]
            if u != 0:
                across += long * abs(u)
                balance += long * u
                weight += long
                area_beyond += turn(mesh.place[b], mesh.place[a], mesh.place[beyond]) // 16
    if weight == 0:
        others = [h - mesh.z[v] for r in region.across.values() for v in r.vertices]
        u = min((u for u in others if u != 0), key=lambda u: (abs(u), u < 0), default=0)
        return quotient(u, 2) or u
    interval = across // weight
    slope = min(128 * across // area_beyond, 1 << 20)
    area = sum(turn(*(mesh.place[v] for v in (a, b, mesh.apex[a, b])))
               for a, b in region.edges) // 3 // 16
    rise = slope * (8 * area // around) // 2048
    rise = max(min(max(rise, interval // 8), interval - interval // 8), 1)
    return -rise if balance < 0 else rise


def summit_place(mesh, region):
    at, apex = mesh.place, mesh.apex

    def middle(p, q):
        return (p[0] + q[0]) // 2, (p[1] + q[1]) // 2

    def acute(a, b):
        (xa, ya), (xb, yb), (xc, yc) = at[a], at[b], at[apex[a, b]]
        return (xa - xc) * (xb - xc) + (ya - yc) * (yb - yc) > 0

    edges = region.free_edges(mesh)
    if edges:
        a, b = max(edges, key=lambda e: (mesh.length(*e), -e[0], -e[1]))
        centre = middle(at[a], at[b])
        left, right = acute(a, b), acute(b, a)
        if left == right:
            return centre
        return middle(centre, at[apex[(a, b) if left else (b, a)]])
    a, b = max(region.edges, key=lambda e: (mesh.length(*e), -min(e), -max(e)))
    return middle(middle(at[a], at[b]), at[apex[a, b]])


def add_summits(mesh):
    """2.4"""
    looks = [(c, side) for c in mesh.contours for side in ((0, 1) if c.count > 1 else (0,))]
    regions = find_regions(mesh)
    changed = True
    while changed:
        changed = False
        for contour, side in looks:
            region = next(r for r in regions
                          if (contour, side) in r.sides or contour.first in r.spots)
            if len({mesh.z[v] for v in region.vertices}) > 1:
                continue
            rise = rise_of(mesh, region)
            if rise == 0:
                continue
            z = mesh.z[region.vertices[0]]
            z = z + rise if abs(z + rise) <= HIGHEST else z - rise
            v = mesh.add(summit_place(mesh, region), z)
            mesh.contours.append(Contour(v, 1, z))
            mesh.include(v)
            mesh.make_delaunay()
            regions = find_regions(mesh)
            changed = True


# --- 2.5 Links ------------------------------------------------------------------------------------


def steepest(mesh, p, spots):
    """Of spot heights, the one with the greatest slope from p; None if no slope is above 0."""
    best, most = None, Fraction(0)
    for v in spots:
        slope = Fraction(abs(mesh.z[v] - mesh.z[p]), mesh.length(p, v))
        if slope > most:
            best, most = v, slope
    return best


def link_fan(mesh, region):
    """A region with one line."""
    edges = region.free_edges(mesh)
    wishes = []
    for p in region.lines()[0].points():
        v = steepest(mesh, p, region.spots)
        if v is None:
            continue
        level = [e for e in edges if p in e and mesh.z[e[0]] == mesh.z[e[1]]]
        if not any(mesh.length(*e) < mesh.length(p, v) for e in level):
            wishes.append((p, v))
    for p, v in wishes:
        if mesh.sees(p, v):
            mesh.force(p, v)


def spots_behind(region, line):
    """The spot heights beyond a line of the region."""
    found, todo = [], [(region, line)]
    while todo:
        here, by = todo.pop()
        beyond = here.across[by]
        found += beyond.spots
        todo += [(beyond, other) for other in beyond.lines() if other is not by]
    return sorted(found)


def crossings(mesh, line, a, b):
    """Where the segments of a line cross ab, in 1/65536 of its length."""
    p, q = mesh.place[a], mesh.place[b]
    for c, d in line.segments():
        r, s = mesh.place[c], mesh.place[d]
        at_a, at_b = turn(r, s, p), turn(r, s, q)
        if (at_a > 0) != (at_b > 0) and (turn(p, q, r) > 0) != (turn(p, q, s) > 0):
            yield 65536 * at_a // (at_a - at_b)


def gap(mesh, region, a, b, line_a, line_b):
    """Where the segment ab leaves line_a and enters line_b: (t_a, t_b), or None."""
    t_b = min(crossings(mesh, line_b, a, b), default=None)
    if t_b is None:
        return None
    t_a = max((t for t in crossings(mesh, line_a, a, b) if t < t_b), default=None)
    if t_a is None or any(t_a < t < t_b for line in region.lines()
                          for t in crossings(mesh, line, a, b)):
        return None
    return t_a, t_b


def link_point(mesh, region, a, b, line_a, line_b, h, o):
    """Tries to join two lines: the new vertex, or None."""
    ways = gap(mesh, region, a, b, line_a, line_b)
    if ways is None:
        return None
    t_a, t_b = ways
    w_a, w_b = abs(mesh.z[a] - h) * (65536 - t_b), abs(mesh.z[b] - h) * t_a
    g = t_b - t_a
    t = t_a + g * w_b // (w_a + w_b + 1)
    t = min(max(t, t_a + g // 8), t_b - g // 8)
    place = tuple((p + ((q - p) * t + 32768) // 65536 + 32) // 64 * 64
                  for p, q in zip(mesh.place[a], mesh.place[b]))
    if not may_link_at(mesh, place, line_a, line_b):
        return None
    m = mesh.add(place, quotient(h + o, 2))
    mesh.include(m)
    mesh.make_delaunay()
    for line in (line_a, line_b):
        seen = [p for p in line.points() if mesh.sees(m, p)]
        if seen:
            mesh.force(m, min(seen, key=lambda p: mesh.length(m, p)))
    mesh.make_delaunay()
    return m


def may_link_at(mesh, place, line_a, line_b):
    """In a triangle, or on a free edge of one, that has a vertex of each of the two lines?"""
    (a, b, c), sides = mesh.find(place)
    zero = [e for e, side in zip(((a, b), (b, c), (c, a)), sides) if side == 0]
    if len(zero) == 2 or any(not mesh.free(*e) or not mesh.inner(*e) for e in zero):
        return False
    triangles = [{a, b, c}] + [{p, q, mesh.apex[q, p]} for p, q in zero]
    return any(t & set(line_a.points()) and t & set(line_b.points()) for t in triangles)


def add_link_points(mesh, region_of):
    """A region with more lines: link points. region_of() is the region as it is now."""
    region = region_of()
    heights = list(dict.fromkeys(line.height for line in region.lines()))
    grounds = heights + [mesh.z[v] for v in mesh.corners if v in region.vertices]
    for h in heights:
        others = [z for z in grounds if z != h]
        o = min(others, key=lambda z: abs(z - h), default=h)
        if abs(h - o) < 2:
            continue
        behind = [(v, line) for line in region.lines() if line.height == h
                  for v in spots_behind(region, line) if (mesh.z[v] - h) * (o - h) < 0]
        behind.sort(key=lambda s: s[0])
        pairs = [(a, b) for i, a in enumerate(behind) for b in behind[i + 1 :] if a[1] is not b[1]]
        pairs.sort(key=lambda p: (mesh.length(p[0][0], p[1][0]), p[0][0], p[1][0]))
        group = {line: line for line in region.lines()}
        failures = 0
        for (a, line_a), (b, line_b) in pairs:
            if group[line_a] is group[line_b]:
                continue
            if link_point(mesh, region, a, b, line_a, line_b, h, o) is not None:
                old, new = group[line_b], group[line_a]
                group = {line: new if g is old else g for line, g in group.items()}
                region = region_of()
                continue
            failures += 1
            if failures == 16:
                break


def link_slopes(mesh, region):
    """A region with more lines: slope links."""
    z = mesh.z
    for line in region.lines():
        if not (line.open or is_left_inside(mesh, line) == ((line, 0) in region.sides)):
            continue
        for p in line.points():
            behind = {}
            for other in region.lines():
                if other is not line and other.height != z[p]:
                    for v in spots_behind(region, other):
                        if (z[v] - other.height) * (other.height - z[p]) > 0:
                            behind[v] = other.height
            v = steepest(mesh, p, order_of_spots(mesh, behind))
            if v is not None:
                link_slope(mesh, region, p, v, behind[v])


def order_of_spots(mesh, spots):
    """In code order, summits that were added after all others."""
    return [c.first for c in mesh.contours if c.count == 1 and c.first in spots]


def is_left_inside(mesh, line):
    """Does a closed line run counter-clockwise?"""
    return sum(xa * yb - ya * xb for (xa, ya), (xb, yb) in
               ((mesh.place[a], mesh.place[b]) for a, b in line.segments())) > 0


def link_slope(mesh, region, p, v, height):
    targets = sorted({q for line in region.lines() if line.height == height
                      for q in line.points()})
    nearest = min(mesh.length(p, q) for q in targets)
    targets = [q for q in targets if mesh.length(p, q) <= nearest + nearest // 4]
    targets.sort(key=lambda q: (off_segment(mesh, p, v, q), q))
    for q in targets[:4]:
        if mesh.sees(p, q):
            mesh.force(p, q)
            return


def off_segment(mesh, p, v, q):
    """The distance of q from the segment pv, in 1/64 step."""
    (px, py), (vx, vy), (qx, qy) = ([c // 4 for c in mesh.place[i]] for i in (p, v, q))
    along = (vx - px) * (qx - px) + (vy - py) * (qy - py)
    whole = (vx - px) ** 2 + (vy - py) ** 2
    if along <= 0:
        return length(qx - px, qy - py)
    if along >= whole:
        return length(qx - vx, qy - vy)
    return abs((vx - px) * (qy - py) - (vy - py) * (qx - px)) // math.isqrt(whole)


def add_links(mesh):
    """2.5"""
    for k, region in enumerate(find_regions(mesh)):
        if not region.sides:
            continue
        if len(region.sides) == 1:
            link_fan(mesh, find_regions(mesh)[k])
        else:
            add_link_points(mesh, lambda k=k: find_regions(mesh)[k])
            link_slopes(mesh, find_regions(mesh)[k])
    mesh.make_delaunay()


# --- 2.6 Skeletons --------------------------------------------------------------------------------


class Branch:
    """A point of a skeleton: its parents, way, and the height h of its bridge."""

    def __init__(self, point, h, parents, way, weight):
        self.point, self.h, self.parents, self.way, self.weight = point, h, parents, way, weight
        self.grown = False


class Skeletons:
    """2.6"""

    def __init__(self, mesh):
        self.mesh = mesh
        self.old = len(mesh.place)
        self.branch = {}
        self.begin()
        self.grow()
        self.meet()
        self.lift()

    def is_bridge(self, a, b):
        mesh = self.mesh
        return (a < self.old and b < self.old and mesh.z[a] == mesh.z[b] and mesh.free(a, b)
                and ((a, b) in mesh.apex or (b, a) in mesh.apex))

    def bridges(self, edges):
        """In order."""
        return [e for e in sorted(key(*e) for e in edges) if self.is_bridge(*e)]

    def thirds(self, a, b):
        apex = self.mesh.apex
        p, q = apex.get((a, b)), apex.get((b, a))
        return (q, q) if p is None else (p, p) if q is None else (p, q)

    def split(self, a, b, parents, weight):
        mesh = self.mesh
        (xa, ya), (xb, yb) = mesh.place[a], mesh.place[b]
        h = mesh.z[a]
        m = mesh.add(((xa + xb) // 2, (ya + yb) // 2), h)
        mesh.split(a, b, m)
        first = parents[0]
        if weight is None:
            weight = self.weight(first, m, h)
        way = (mesh.length(first, m) >> 5) * weight
        if first >= self.old:
            way += self.branch[first].way
        self.branch[m] = Branch(m, h, parents, min(way, (1 << 32) - 1), weight)

    def weight(self, p, m, h):
        mesh = self.mesh
        rise = mesh.z[p] - h
        steep = [256 * abs(mesh.z[q] - mesh.z[p]) // mesh.length(p, q) for q in mesh.round(p)
                 if q < self.old and (mesh.z[q] - mesh.z[p]) * rise > 0]
        slope = max(steep, default=0) or 256 * abs(rise) // mesh.length(p, m)
        return min(max(slope, 1), 1 << 14)

    def begin(self):
        mesh, points = self.mesh, self.mesh.points
        for a, b in self.bridges(mesh.edges()):
            if not mesh.inner(a, b) and b >= points:
                continue  # on the frame
            h = mesh.z[a]
            p, q = self.thirds(a, b)

            def other_ground(v):
                return v < self.old and mesh.z[v] != h

            if not other_ground(p):
                p, q = q, p
            if not other_ground(p):
                continue
            if other_ground(q):
                if (mesh.z[p] - h) * (mesh.z[q] - h) > 0:
                    self.split(a, b, sorted((p, q)), None)
            elif q < self.old:
                self.split(a, b, [p], None)
            else:
                self.split(a, b, sorted((p, q)), None)

    def grow(self):
        mesh = self.mesh
        while True:
            waiting = [b for b in self.branch.values() if not b.grown]
            if not waiting:
                return
            m = min(waiting, key=lambda b: (b.way, b.point))
            m.grown = True
            opposite = [(a, b) for (a, b), c in mesh.apex.items() if c == m.point]
            for a, b in self.bridges(opposite):
                p, q = self.thirds(a, b)
                q = p if q == m.point else q
                if q >= self.old or mesh.z[q] != m.h:
                    self.split(a, b, [m.point, q], m.weight)
                else:
                    self.split(a, b, [m.point], m.weight)

    def trace(self, m, parent):
        """From a meeting point by one of its parents: the old vertex there, and the way to it."""
        way = self.mesh.length(m, parent)
        while parent >= self.old:
            before = self.branch[parent].parents[0]
            way += self.mesh.length(parent, before)
            parent = before
        return parent, way

    def keep_off(self, z, h, z_side, by):
        """z, but at least `by` off h on the side of z_side."""
        return max(z, h + by) if z_side > h else min(z, h - by)

    def meet(self):
        """Heights of the meeting points."""
        mesh = self.mesh
        for m, branch in self.branch.items():
            if len(branch.parents) == 1:
                continue
            (a, alpha), (b, beta) = (self.trace(m, p) for p in branch.parents)
            z_a, z_b, h = mesh.z[a], mesh.z[b], branch.h
            if z_a == z_b:
                z = quotient(z_a + h, 2)
            else:
                z = z_a + quotient((z_b - z_a) * alpha, alpha + beta)
            branch.z = self.keep_off(z, h, z_a, max(abs(h - z_a) // 8, 1))

    def lift(self):
        """Heights of the others."""
        mesh = self.mesh
        far, end = {}, {}
        children = {m: [] for m in self.branch}
        for m, branch in self.branch.items():
            for p in set(branch.parents):
                if p >= self.old:
                    children[p].append(m)
        for m, branch in reversed(self.branch.items()):
            if len(branch.parents) == 2:
                far[m], end[m] = 0, m
            elif children[m]:
                newest = max(children[m], key=lambda c: (mesh.length(m, c) + far[c], c))
                far[m], end[m] = mesh.length(m, newest) + far[newest], end[newest]
            else:
                far[m] = max(mesh.length(m, v) for v in mesh.round(m)
                             if v < self.old and mesh.z[v] == branch.h)
                end[m] = None
        for m, branch in self.branch.items():
            if len(branch.parents) == 2:
                mesh.z[m] = branch.z
        for m, branch in self.branch.items():
            if len(branch.parents) == 1:
                (p,), h = branch.parents, branch.h
                z_p, long = mesh.z[p], mesh.length(p, m)
                z_e = h if end[m] is None else mesh.z[end[m]]
                z = z_p + quotient((z_e - z_p) * long, long + far[m])
                by = max(abs(h - z_p) // 8, 1) if p < self.old else 1
                mesh.z[m] = self.keep_off(z, h, z_p, by)


# --- 2.7 Slopes -----------------------------------------------------------------------------------


def find_slopes(mesh):
    """2.7: (g_x, g_y) of each vertex."""
    sums = [[0, 0, 0] for _ in mesh.place]
    for corner in mesh.triangles():
        (xa, ya), (xb, yb), (xc, yc) = ([c // 32 for c in mesh.place[v]] for v in corner)
        za, zb, zc = (mesh.z[v] for v in corner)
        if za == zb == zc:
            continue
        normal = ((yb - ya) * (zc - za) - (zb - za) * (yc - ya),
                  (zb - za) * (xc - xa) - (xb - xa) * (zc - za),
                  (xb - xa) * (yc - ya) - (yb - ya) * (xc - xa))
        for v in corner:
            for k in range(3):
                sums[v][k] += normal[k]
    slopes = [tuple(min(max(-64 * n // up, -8192), 8192) for n in (east, north)) if up else (0, 0)
              for east, north, up in sums]
    return [limited(mesh, v, slope) for v, slope in enumerate(slopes)]


def limited(mesh, v, slope):
    """The slope that lets no edge at v overshoot."""
    least = 1 << 15
    for w in mesh.round(v):
        rise = mesh.z[w] - mesh.z[v]
        along = sum(g * (q - p) for g, p, q in zip(slope, mesh.place[v], mesh.place[w]))
        if rise * along > 0 and abs(along) > 3072 * abs(rise):
            least = min(least, (3072 * abs(rise) << 15) // abs(along))
    return tuple(g * least >> 15 for g in slope)


# --- 3. The surface -------------------------------------------------------------------------------


LOG_TABLE = [round(2048 * math.log2(1 + i / 32)) for i in range(33)]
EXP_TABLE = [round(32768 * (2 ** (i / 32) - 1)) for i in range(33)]


def lg(a):
    """3.1"""
    n = a.bit_length() - 1
    fraction = ((a << 16 >> n) if n < 16 else a >> (n - 16)) & 0xFFFF
    i, r = fraction >> 11, fraction & 2047
    low, high = LOG_TABLE[i], LOG_TABLE[i + 1]
    return 2048 * n + low + ((high - low) * r + 1024) // 2048


def ex(e):
    """3.1"""
    n, i, r = e >> 11, (e & 2047) >> 6, e & 63
    low, high = EXP_TABLE[i], EXP_TABLE[i + 1]
    m = 32768 + low + ((high - low) * r + 32) // 64
    if n < -1:
        return 0
    if n >= 32:
        return (1 << 32) - 1
    return min(m << (n - 15) if n >= 15 else (m + (1 << (14 - n))) >> (15 - n), (1 << 32) - 1)


def plan_square(dx, dy):
    """q of class() in 3.1"""
    return (abs(dx) // 2) ** 2 + (abs(dy) // 2) ** 2


def length_class(dx, dy):
    """3.1"""
    q = plan_square(dx, dy)
    if q < 2:
        return 0
    n = q.bit_length() - 1
    return 2 * n + (q >> (n - 1) & 1)


def noise(x, y, seed):
    """3.1"""
    whole = 0xFFFFFFFF
    h = (x + (y << 16) + (seed + 1) * 0x9E3779B9) & whole
    h = (h ^ h >> 16) * 0x7FEB352D & whole
    h = (h ^ h >> 15) * 0x846CA68B & whole
    h ^= h >> 16
    return min(max(sum(h.to_bytes(4, "big")) - 510, -320), 320)


def noise_scale(mesh, plan):
    """3.3: S_c of the 64 classes"""
    total, hurst = 0, plan.hurst
    edges = mesh.edges()
    for a, b in edges:
        rise = abs(mesh.z[a] - mesh.z[b])
        if rise > 0:
            (xa, ya), (xb, yb) = mesh.place[a], mesh.place[b]
            t = 2 * lg(rise) - hurst * (lg(plan_square(xa - xb, ya - yb)) - 14 * 2048) // 256
            total += ex(t + 8 * 2048) if t < 24 * 2048 else 256 * ex(t)
    mean = total // len(edges)
    w = 65536 - ex(8 * (2 * hurst - 512) + 16 * 2048)
    if plan.gain == 0 or w <= 0 or mean == 0:
        return [0] * 64
    r = lg(mean) - 8 * 2048
    v = r + lg(w) - 16 * 2048 - 16 * hurst
    amplitude = v // 2 + lg(plan.gain) - 5 * 2048
    return [min(65535, ex(amplitude + hurst * ((1024 * min(c, 48) + 512 - 14 * 2048) // 2) // 256
                          + 9 * 2048 - 14712)) for c in range(64)]


PARTS = {
    (): ((0, 1, 2),),
    (0,): ((0, 3, 2), (3, 1, 2)),
    (1,): ((1, 4, 0), (4, 2, 0)),
    (2,): ((2, 5, 1), (5, 0, 1)),
    (0, 1): ((4, 3, 1), (2, 0, 3), (2, 3, 4)),
    (1, 2): ((5, 4, 2), (0, 1, 4), (0, 4, 5)),
    (0, 2): ((3, 5, 0), (1, 2, 5), (1, 5, 3)),
    (0, 1, 2): ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)),
}


class Map:
    """vertex: (x, y, z, g_x, g_y), the first `coded` before the rules; triangle: three numbers;
    scale: S_c."""

    def __init__(self, plan, mesh):
        self.coded = mesh.coded
        self.seed, self.smooth = plan.seed, plan.smooth
        self.cell, self.unit, self.base = plan.cell, plan.unit, plan.base
        slopes = find_slopes(mesh)
        self.vertex = [(*mesh.place[v], mesh.z[v], *slopes[v]) for v in range(len(mesh.place))]
        self.triangle = mesh.triangles()
        self.scale = noise_scale(mesh, plan)

    def midpoint(self, a, b, detail):
        """3.2"""
        (xa, ya, za, gxa, gya), (xb, yb, zb, gxb, gyb) = a, b
        dx, dy = xb - xa, yb - ya
        x, y = (xa + xb) // 2, (ya + yb) // 2
        z = (za + zb) // 2
        if self.smooth:
            z += ((gxa - gxb) * dx + (gya - gyb) * dy + 8192) // 16384
        if detail:
            limit = max(0, length(dx, dy) - abs(zb - za) // 2)
            rough = (self.scale[length_class(dx, dy)] * noise(x, y, self.seed) + 256) // 512
            z += min(max(rough, -limit), limit)
        return x, y, z, (gxa + gxb) // 2, (gya + gyb) // 2

    def parts(self, corner, detail):
        """3.4: what a triangle is split into, one step on; None: it is left whole."""
        points, split = list(corner), []
        for k in range(3):
            a, b = corner[k], corner[(k + 1) % 3]
            dx, dy = b[0] - a[0], b[1] - a[1]
            if length(dx, dy) > 256 and dx % 2 == 0 and dy % 2 == 0:
                split.append(k)
                points.append(self.midpoint(a, b, detail))
            else:
                points.append(None)
        if not split:
            return None
        return [tuple(points[i] for i in part) for part in PARTS[tuple(split)]]

    def height(self, x, y, detail=True):
        """3.4: of the reference surface"""
        parts = [tuple(self.vertex[v] for v in corner) for corner in self.triangle]
        while parts is not None:
            corner = next(c for c in parts if holds(c, (x, y)))
            parts = self.parts(corner, detail)
        a, b, c = corner
        weights = turn(b, c, (x, y)), turn(c, a, (x, y)), turn(a, b, (x, y))
        return sum(w * p[2] for w, p in zip(weights, corner)) // turn(a, b, c)


def holds(corner, place):
    a, b, c = corner
    return min(turn(a, b, place), turn(b, c, place), turn(c, a, place)) >= 0


def build(plan):
    check_contours(plan)
    mesh = triangulate(plan)
    add_summits(mesh)
    add_links(mesh)
    Skeletons(mesh)
    return Map(plan, mesh)


def decode(code, room=255):
    """`room`: for so many vertices"""
    read = Bytes(code)
    try:
        found = build(read_code(read, room))
        if read.at < len(code):
            read.at += 1
            raise Refused("corrupt")
    except Refused as refused:
        refused.after = len(code) if str(refused) == "truncated" else read.at
        raise
    return found

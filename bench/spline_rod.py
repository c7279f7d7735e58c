#!/usr/bin/env python3
"""A rod of cubic splines beside discrete elastic rods: error, noise and cost.

Both have the same energies, contact law and Newton's method; what differs is the curve between their points, one every
`spacing`. Units: bending stiffness 1; lengths in radii h of the rod, at the capstan in those of its bend."""
import argparse
import numpy as np
from matplotlib.figure import Figure
import scipy.sparse as sp
from scipy.interpolate import CubicSpline
from scipy.sparse.linalg import splu
from scipy.spatial import cKDTree

# Weights of the points of a span in powers of u: the quadratic and the cubic B-spline.
QUADRATIC = np.array([[0.5, -1, 0.5], [0.5, 1, -1], [0, 0, 0.5]])
CUBIC = np.array([[1, -3, 3, -1], [4, 0, -6, 3], [1, 3, 3, -3], [0, 0, 0, 1]]) / 6.0
GAUSS = 0.5 + np.array([-0.5, 0.5]) / np.sqrt(3.0)
TURN = [2.0 / (n * n) * 4.0**n / np.prod([(n + k) / k for k in range(1, n + 1)]) for n in range(1, 24)]

dot = lambda a, b: (a * b).sum(-1)
unit = lambda a: a / np.linalg.norm(a, axis=1)[:, None]
outer = lambda a, b: a[:, :, None] * b[:, None, :]
across = lambda n, d: (np.eye(3) - outer(n, n)) / d[:, None, None]
in_space = lambda rows: sp.kron(rows, sp.eye(3), 'csr')
summary = lambda off: (np.mean(off), np.sqrt(np.mean(np.square(off))), np.ptp(off))

def stacked(operators):
    """One operator that gives the vectors of all of them, point by point."""
    rows = np.arange(3 * len(operators) * operators[0].shape[0]).reshape(len(operators), operators[0].shape[0], 3)
    return sp.vstack([in_space(o) for o in operators]).tocsr()[rows.transpose(1, 0, 2).ravel()]

def sandwich(left, blocks, right=None):
    """left' diag(blocks) right, for a stack of dense blocks."""
    shape = len(blocks) * blocks.shape[1], len(blocks) * blocks.shape[2]
    middle = sp.bsr_matrix((blocks, np.arange(len(blocks)), np.arange(len(blocks) + 1)), shape)
    return left.T @ (middle @ (left if right is None else right))

# Slopes of the energies per length. They also take complex numbers, of which the second derivatives are made.
def stretching(y, weight):
    size = np.sqrt(dot(y, y))[:, None]
    return weight * (size - 1.0) / size * y

def bending_of_corner(y, weight):
    """Half the squared turning angle between two edges over their length squared, as the project has it."""
    e, f = y[:, :3], y[:, 3:]
    size_e, size_f = np.sqrt(dot(e, e))[:, None], np.sqrt(dot(f, f))[:, None]
    u, v = e / size_e, f / size_f
    w, c = 0.25 * dot(v - u, v - u)[:, None], dot(u, v)[:, None]
    slope = 0.25 * weight * sum(n * a * w**(n - 1) for n, a in enumerate(TURN, 1))
    return slope * np.hstack([(c * u - v) / size_e, (c * v - u) / size_f])

def bending_of_curve(y, weight):
    """Half of |dt/ds|^2 = |c' x c''|^2/|c'|^4, s the length at rest."""
    t, k = y[:, :3], y[:, 3:]
    p, q, r = (dot(a, b)[:, None] for a, b in ((t, t), (k, k), (t, k)))
    in_t = (q * t - r * k) / p**2 - 2.0 * (p * q - r * r) / p**3 * t
    return weight * np.hstack([in_t, (p * k - r * t) / p**2])

class Rod:
    """`edges` spans of one spacing between points 0 and `edges`; spline: the curve begins and ends there, unbent."""
    def __init__(self, spline, edges, spacing, stiffness, per_span, stretch_points=1):
        self.spline, self.edges, self.spacing, n, l = spline, edges, spacing, edges, spacing
        self.nodes, self.spans, self.start = n + 1, n if spline else n - 1, 0.0 if spline else 0.5 * l
        self.weights, self.ghosts, self.iterations = CUBIC if spline else QUADRATIC, sp.eye(n + 1, format='csr'), 0
        if spline:  # a point before and one behind, so that the bend vanishes at either end
            ends = sp.csr_matrix(([2, -1, 2, -1], ([0, 0, n + 2, n + 2], [0, 1, n, n - 1])), (n + 3, n + 1))
            self.ghosts, self.bulge = (ends + sp.eye(n + 3, n + 1, -1)).tocsr(), sp.csr_matrix((n, n + 1))
            at = lambda points, order: self.rows(*self.everywhere(points), order) / l**order
            stretch, bend = [at([0.5] if stretch_points == 1 else GAUSS, 1)], [at(GAUSS, 1), at(GAUSS, 2)]
        else:
            edge = sp.diags([-1.0 / l, 1.0 / l], [0, 1], (n, n + 1), format='csr')
            self.second = sp.diags([1.0, -2.0, 1.0], [0, 1, 2], (n - 1, n + 1), format='csr')
            stretch, bend, stretch_points = [edge], [edge[:-1], edge[1:]], 1
        self.terms = [(stretching, 1, stacked(stretch), stiffness * l / stretch_points),
                      (bending_of_curve if spline else bending_of_corner, 2, stacked(bend), 0.5 * l if spline else 1.0 / l)]
        self.at, self.per_point = self.everywhere((np.arange(per_span) + 0.5) / per_span), l / per_span
        self.at_s = self.start + l * sum(self.at)
    def everywhere(self, points):
        return np.repeat(np.arange(self.spans), len(points)), np.tile(points, self.spans)
    def rows(self, span, u, order=0):
        """Weights of all points in the curve's order-th derivative in u."""
        w = self.weights
        for _ in range(order):
            w = w[:, 1:] * np.arange(1, w.shape[1])
        index, value = span[:, None] + np.arange(len(w)), np.vander(u, w.shape[1], increasing=True) @ w.T
        parts = value.ravel(), index.ravel(), np.arange(len(span) + 1) * len(w)
        return sp.csr_matrix(parts, (len(span), self.ghosts.shape[0])) @ self.ghosts
    def outwards(self, span, u):
        """Weights of the shift by which the arc of the rod's own length stands outwards of a quadratic spline."""
        other, part = np.clip(span + np.where(u < 0.5, -1, 1), 0, self.spans - 1), np.abs(u - 0.5)
        return sp.diags(1.0 - part) @ self.bulge[span] + sp.diags(part) @ self.bulge[other]
    def refresh(self, P):
        """Shifts outwards for the present shape: constant while Newton's method runs, as within a step."""
        self.points, self.tangents = self.rows(*self.at), self.rows(*self.at, 1)
        if not self.spline:
            turn = np.linalg.norm(self.second @ P, axis=1) / self.spacing
            self.bulge = (sp.diags(-np.maximum(0.0, 1.0 - 0.25 * turn**2)**2 / 12.0) @ self.second).tocsr()
            self.points = self.points + self.bulge[self.at[0]]
    def elastic(self, P):
        residual, matrix = 0.0, 0.0
        for slope, vectors, operator, weight in self.terms:
            y = (operator @ P.ravel()).reshape(-1, 3 * vectors)
            steps = 1e-30j * np.eye(3 * vectors)
            blocks = np.stack([slope(y + step, weight).imag * 1e30 for step in steps], axis=-1)
            residual, matrix = residual + operator.T @ slope(y, weight).ravel(), matrix + sandwich(operator, blocks)
        return residual, matrix
    def fit(self, curve):
        """Points whose curve is at the right place at every multiple of the spacing."""
        target, span = curve(self.spacing * np.arange(self.nodes)), np.minimum(np.arange(self.nodes), self.edges - 1)
        return splu(self.rows(span, np.arange(self.nodes) - span).tocsc()).solve(target) if self.spline else target
    def curve(self, P):
        """A spline's curve, to begin another rod with."""
        knots = self.rows(np.arange(self.spans), np.zeros(self.spans)) @ P
        return CubicSpline(self.spacing * np.arange(self.nodes), np.vstack([knots, P[-1:]]))
    def largest_curvature(self, P):
        a, b = (self.terms[1][2] @ P.ravel()).reshape(-1, 2, 3).transpose(1, 0, 2)
        angle = np.arccos(np.clip(dot(unit(a), unit(b)), -1.0, 1.0)) / self.spacing
        return np.max(np.linalg.norm(np.cross(a, b), axis=1) / dot(a, a) if self.spline else angle)

def pressure(stiffness, tolerance, overlap):
    """p = K s and its slope, s the overlap with a corner that the tolerance rounds."""
    part = np.clip(overlap / tolerance + 0.5, 0.0, 1.0)
    return stiffness * np.where(part < 1.0, 0.5 * part * part * tolerance, overlap), stiffness * part

class Post:
    """A round post along z, with friction of a rod that slides in its own direction everywhere."""
    def __init__(self, radius, *law):
        self.radius, self.law, self.friction = radius, law, 0.0
    def __call__(self, rod, P):
        x = rod.points @ P
        touch = np.linalg.norm(x, axis=1) < self.radius + 0.5 * self.law[1]
        operator, w = in_space(rod.points[touch]), -rod.per_point
        n, d = unit(x[touch]), np.linalg.norm(x[touch], axis=1)
        p, slope = (a[:, None, None] for a in pressure(*self.law, self.radius - d))
        lean = np.eye(3) - self.friction * np.array([[0, -1, 0], [1, 0, 0], [0, 0, 0]])  # from n to the force's direction
        change = lean @ (p * across(n, d) - slope * outer(n, n))
        return w * (operator.T @ (p[:, 0] * (n @ lean.T)).ravel()), w * sandwich(operator, change)

class Strands:
    """Strands on strands: every point on its feet, each of the two sides with half of the weight. Friction acts
    against the motion of a knot that is being tightened: either half of the rod slides towards its own end."""
    def __init__(self, friction, *law):
        self.friction, self.law = friction, law
    def overlaps(self, rod, P, points, s):
        """Points and their feet, the places of other strands (6 h away along the rod) that are locally nearest."""
        a, ends = points @ P, [[rod.rows(*rod.everywhere([u]), order) @ P for order in (0, 1)] for u in (0.0, 1.0)]
        near = cKDTree(0.5 * (ends[0][0] + ends[1][0])).query_ball_point(a, 2.3 + 0.6 * rod.spacing)
        i, j = np.repeat(np.arange(len(a)), [len(k) for k in near]), np.concatenate([np.asarray(k, int) for k in near])
        low, high = (dot(c[j] - a[i], t[j]) for c, t in ends)
        foot = (np.abs(s[i] - rod.start - rod.spacing * (j + 0.5)) > 6.0) & (low < 0.0) & (high >= 0.0)
        i, j, u = i[foot], j[foot], (low / (low - high))[foot]
        for _ in range(8):
            b, b1, b2 = (rod.rows(j, u, k) @ P for k in range(3))
            u = np.clip(u - dot(b - a[i], b1) / (dot(b1, b1) + dot(b - a[i], b2)), 0.0, 1.0)
        b, shift = rod.rows(j, u), rod.outwards(j, u)
        x = a[i] - b @ P
        d, n = np.linalg.norm(x, axis=1), unit(x)
        return i, j, u, x, d, n, b, shift, 2.0 - d - dot(n, shift @ P)
    def __call__(self, rod, P):
        every = self.overlaps(rod, P, rod.points, rod.at_s)
        i, j, u, x, d, n, b, shift, overlap = (e[every[-1] > -0.5 * self.law[1]] for e in every)
        p, slope = pressure(*self.law, overlap)
        b_1, b2, half = rod.rows(j, u, 1), rod.rows(j, u, 2) @ P, 0.5 * rod.edges * rod.spacing
        b1 = b_1 @ P
        along = unit(rod.tangents[i] @ P) * np.sign(rod.at_s[i] - half)[:, None]
        z = unit(along - unit(b1) * np.sign(rod.start + rod.spacing * (j + u) - half)[:, None])
        push = n - self.friction * z
        w, apart, moved = 0.5 * rod.per_point, in_space(rod.points[i] - b), in_space(rod.points[i] - b + shift)
        # Second derivatives of the distance, the foot's motion along its strand eliminated.
        flat = across(n, d)
        q = np.hstack([-np.einsum('nij,nj->ni', flat, b1), -n])
        bends = -(d / (dot(b1, b1) - dot(x, b2)))[:, None, None] * outer(q, q)
        bends[:, :3, :3] += flat
        matrix = sandwich(stacked([rod.points[i] - b, b_1]), -w * p[:, None, None] * bends)
        matrix = matrix + sandwich(apart, w * slope[:, None, None] * outer(push, n), moved)
        return -w * (apart.T @ (p[:, None] * push).ravel()), matrix

def rest(rod, P, contact, free, load, residual, cap, drag, passes=4, longest=2000):
    """Newton's method to equilibrium; a drag that fades as steps get small leads there from afar."""
    P = P.copy()
    for _ in range(passes):
        rod.refresh(P)
        for iteration in range(longest):
            (r, matrix), (r_contact, m_contact) = rod.elastic(P), contact(rod, P)
            r, rod.matrix = r + r_contact - load, (matrix + m_contact).tocsr()
            if np.abs(r[free]).max() < residual:
                break
            step = splu((rod.matrix[free][:, free] + drag * sp.eye(len(free))).tocsc()).solve(-r[free])
            far = np.abs(step).max() / cap
            P.ravel()[free] += step / max(1.0, far)
            drag *= 2.0 if far > 1.0 else 0.5 if far < 0.3 else 1.0
        else:
            raise RuntimeError('does not come to rest')
        rod.iterations += iteration
        if iteration == 0:
            break
    return P, r

def capstan(t1, phase, spline, spacing, per_span, stretch_points=1, mu=0.3):
    """T2/T1 where the rod slides; the phase shifts its points by a part of the spacing."""
    low, high = 7.0 / np.sqrt(t1) + 1.0, 7.0 / np.sqrt(5.0 * t1) + 1.0
    rod = Rod(spline, int(np.ceil((low + high + 2.0 * np.pi) / spacing)) + 1, spacing, 1e4 * t1, per_span, stretch_points)
    on = lambda s: np.clip(s - low - phase * spacing, 0.0, 2.0 * np.pi)
    arc = lambda a, off: np.c_[np.cos(a) - off * np.sin(a), np.sin(a) + off * np.cos(a), 0.0 * a]
    shape = lambda s: arc(on(s), s - low - phase * spacing - on(s))
    P, contact, load = rod.fit(shape), Post(1.0, 2e3 * t1, 1e-3), np.zeros(3 * rod.nodes)
    load[1] = -t1  # a dead load; the other end is held along its own tail only
    free = np.setdiff1d(np.arange(3 * rod.nodes), np.r_[2:3 * rod.nodes:3, 3 * rod.nodes - 2])
    for contact.friction in np.linspace(0.0, mu, 4):
        P, r = rest(rod, P, contact, free, load, 1e-8 * t1, 0.05, 10.0 * t1)
    return r[-2] / t1

def drawn_overhand(R, length):
    """A loop of radius R whose strands wind one and a half times around each other, by arclength."""
    s = np.linspace(-0.5 * length, 0.5 * length, int(8 * length)) * 1.1 + np.pi * R
    on = np.clip(s, 0.0, 2.0 * np.pi * R)
    x, y = R * np.sin(on / R) + s - on, R * (1.0 - np.cos(on / R))
    near = (np.abs(x) < 0.95 * R) & (y < R)
    apart = R - np.sqrt(R * R - np.where(near, x, 0.0)**2)
    angle = 1.5 * np.pi * (1.0 - np.tanh(x / (1.75 * np.sqrt(R))))
    side = np.where(s < np.pi * R, 0.5, -0.5) * np.hypot(apart, 2.3)
    part = np.where(near, np.sin(0.5 * np.pi * np.clip((0.95 - np.abs(x) / R) / 0.4, 0.0, 1.0))**2, 0.0)
    p = np.c_[x, y + part * (0.5 * apart + side * np.cos(angle) - y), part * side * np.sin(angle)]
    arc = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(p, axis=0), axis=1))]
    return CubicSpline(arc - 0.5 * (arc[-1] - length), p)

class Overhand:
    """An open overhand between pins, its middle held on the axis about which it is symmetric; a solid rod."""
    def __init__(self, curve, eps, mu, tolerance, spline, spacing, per_span):
        self.R, self.unit = eps**-2, 0.5 * eps**4
        self.length = 8.0 * np.ceil((2.0 * np.pi + 10.0) * self.R / 8.0)
        self.rod = Rod(spline, int(round(self.length / spacing)), spacing, 4.0, per_span)
        self.P = self.rod.fit(curve or drawn_overhand(1.1 * self.R, self.length))
        self.contact, self.middle, n = Strands(mu, 300.0, tolerance), self.rod.nodes // 2, 3 * self.rod.nodes
        self.free = np.setdiff1d(np.arange(n), [0, 1, 2, 3 * self.middle, 3 * self.middle + 2, n - 3, n - 2, n - 1])
    def force(self, e, drag=0.1):
        """Pulls the ends to the end shortening e in strides of the radius; the force over eps^4/2, and largest curvature."""
        side, last = np.arange(self.rod.nodes) / self.middle - 1.0, False
        self.P[self.middle, 0] = self.P[self.middle, 2] = 0.0
        while not last:
            half, to = 0.5 * (self.P[-1, 0] - self.P[0, 0]), 0.5 * (self.length - e)
            last, step = abs(to - half) <= 1.0, np.clip(to - half, -1.0, 1.0)
            self.P[:, 0] += step * np.sign(side) * np.clip((np.abs(side) - 0.7) / 0.3, 0.0, 1.0)
            self.P[0], self.P[-1] = (-half - step, 0.0, 0.0), (half + step, 0.0, 0.0)
            goal = (self.unit * 1e-7, 0.1, drag, 5) if last else (self.unit * 1e-3, 0.1, drag, 1)
            self.P, r = rest(self.rod, self.P, self.contact, self.free, 0.0, *goal)
        return 0.5 * (r[-3] - r[0]) / self.unit, self.rod.largest_curvature(self.P)
    def deepest(self):
        """Largest overlap anywhere on the curves, between the points of integration, too."""
        span, u = self.rod.everywhere((np.arange(16) + 0.5) / 16.0)
        at = self.rod.rows(span, u) + self.rod.outwards(span, u)
        return self.contact.overlaps(self.rod, self.P, at, self.rod.start + self.rod.spacing * (span + u))[-1].max()
    def fill(self):
        """Blocks of the matrix, blocks of a triangular factor, products of blocks; each per length of 100 h."""
        block, n = self.rod.matrix.tobsr((3, 3)), self.rod.nodes
        pattern = sp.csr_matrix((np.ones(len(block.indices)), block.indices, block.indptr), (n, n))
        lower = splu((pattern + n * sp.eye(n)).tocsc(), 'MMD_AT_PLUS_A', 0.0, options={'SymmetricMode': True}).L
        below = np.diff(lower.indptr) - 1
        return np.array([pattern.nnz, lower.nnz, below @ (below + 1)]) / self.length * 100.0

KINDS = {'edges, 2 points': (0, 2), 'edges, 4': (0, 4), 'spline, 2': (1, 2), 'spline, 4': (1, 4), '4, 2 of stretch': (1, 4, 2)}
# Shares of an iteration of today: solve, matrix, elastic terms, search of feet, contact law, its memory, the rest.
SHARES = np.array([0.212, 0.148, 0.187, 0.085, 0.157, 0.089, 0.122])

def cost(q, blocks, products):
    """An iteration at q times the spacing, 4 points a span, over one of today; blocks and products are those of q = 2.
    A place of bending has 4 nodes instead of 3, a contact 8 instead of 6."""
    return SHARES @ [2 / q * products, 2 / q * blocks, 2 / q * 16 / 9, 2 / q**2 * 4 / 3, 2 / q * 64 / 36, 2 / q, 1.0]

def report(spacings, table):
    """Mean error +- half of the ripple, rms, orders; then the spacings at which the spline is as good as edges."""
    for kind, rows in table.items():
        rms = [r[1] for r in rows]
        print(f'  {kind:16s}', *(f'{m:8.1e} +- {0.5 * p:.1e}' for m, _, p in rows), ' rms', *(f'{x:.1e}' for x in rms),
              ' orders', *(f'{np.log2(a / b):.1f}' for a, b in zip(rms, rms[1:])))
    logs, found = np.log([[s, r[1]] for s, r in zip(spacings, table['spline, 4']) if r[1] > 0.0][::-1]).T, {}
    for s, (_, rms, _) in zip(spacings, table['edges, 2 points']):
        if logs[1, 0] <= np.log(rms) <= logs[1, -1]:
            found[s] = np.exp(np.interp(np.log(rms), logs[1], logs[0])) / s
            print(f'    as good as edges of {s:g}: the spline at {found[s]:.2f} times their spacing')
    return found

def capstans(spacings=(0.5, 0.25, 0.125, 0.0625)):
    tables = {}
    for t1, closed in ((2.0, 5.319), (10.0, 6.305), (50.0, 6.527)):
        own = capstan(t1, 0.0, True, 1.0 / 32.0, 4)
        print(f'Capstan, T1 rho^2/B = {t1:g}: T2/T1 of the closed form {closed}, resolved {own:.4f},',
              f'edges of 1/64 {capstan(t1, 0.0, False, 1.0 / 64.0, 2):.4f}; errors at spacings', *spacings, flush=True)
        tables[t1] = {kind: [summary([capstan(t1, k / 8, how[0], s, *how[1:]) / own - 1.0 for k in range(8)]) for s in spacings]
                      for kind, how in KINDS.items()}
        report(spacings, tables[t1])
    return spacings, tables

def overhand(eps, mu, tolerance, spacings=(4.0, 2.0, 1.0, 0.5)):
    """Each knot is pulled while a strand slides by one spacing; errors are those against a resolved spline."""
    make = lambda curve, mu, *how: Overhand(curve, eps, mu, tolerance, *how)
    first = make(None, 0.0, True, 1.0 if eps > 0.25 else 2.0, 4)
    loose = 2.0 * np.pi * first.R + 2.0
    first.force(loose)
    fine, at = make(first.rod.curve(first.P), mu, True, 0.25, 4), loose - np.linspace(0.0, 8.0, 6)
    own = np.array([fine.force(e, 1e-3) for e in at])
    smooth = np.polyfit(loose - at, np.log(own), 5)
    table, fills, deepest, over_R = {}, {}, fine.deepest(), 2.0 * np.pi / at[1]
    theory = (0.5 * over_R**2 + mu * 0.492 * over_R**1.5) / first.unit
    fine.force(loose, 1e-3)
    start = fine.rod.curve(fine.P)
    check = make(start, mu, False, 0.125 if eps > 0.15 else 0.25, 2).force(loose, 1e-3)[0] / own[0, 0] - 1.0  # finer ones round
    print(f'Overhand, eps = {eps:g}, mu = {mu:g}, delta = {tolerance:g} h: force over theory {own[1, 0] / theory:.3f},',
          f'largest curvature {own[1, 1]:.4f}/h, overlap {deepest:.4f} h; fine edges off by {check:.1e}')
    for kind, how in list(KINDS.items())[:4]:
        for s in spacings:
            knot, e = make(start, mu, how[0], s, how[1]), loose - np.arange(8) / 4 * s
            try:
                off = np.array([knot.force(x) / np.exp(np.polyval(smooth, loose - x)) - 1.0 for x in e]).T
            except RuntimeError as error:
                print(f'  {kind}, {s:g} h: {error}')
                off = np.full((2, 8), np.nan)
            table.setdefault(kind, []).append(summary(off[0]))
            fills[kind, s] = knot.fill()
            print(f'  {kind:16s} {s:4g} h: curvature {summary(off[1])[1]:.1e}, overlap {knot.deepest():7.4f} h,',
                  'blocks, factor, products', *np.round(fills[kind, s]).astype(int), ' iterations', knot.rod.iterations)
    for s, q in report(spacings, table).items():
        if (kind := ('spline, 4', 2.0 * s)) in fills:
            blocks, _, products = fills[kind] / fills['edges, 2 points', s]
            print(f'    an iteration there costs {cost(q, blocks, products):.2f} of one with edges of {s:g} h, at twice',
                  f'the spacing {cost(2.0, blocks, products):.2f} (blocks {blocks:.2f}, products {products:.2f})')
    return table

def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--out', help='picture of the errors')
    parser.add_argument('--eps', type=float, nargs='*', default=[0.15, 0.2, 0.3, 0.4])
    for name, help_text in (('--mu', 'friction of the overhand'), ('--tolerance', 'of its contact [h]')):
        parser.add_argument(name, type=float, default=0.1, help=help_text)
    options = parser.parse_args()
    cases = [('capstan: spacing over radius of the bend', 'T1 rho^2/B', *capstans())]
    knots = {eps: overhand(eps, options.mu, options.tolerance) for eps in options.eps}
    cases.append(('overhand: spacing over h', 'eps', (4.0, 2.0, 1.0, 0.5), knots))
    figure = Figure(figsize=(10, 4.2), layout='constrained')
    for ax, (title, name, spacings, tables) in zip(figure.subplots(1, 2), cases):
        for n, (case, table) in enumerate(tables.items()):
            for kind, line in (('edges, 2 points', '--'), ('spline, 4', '-')):
                ax.loglog(spacings, [r[1] for r in table[kind]], f'C{n}o{line}', label=f'{kind}, {name} = {case:g}')
        ax.set(xlabel=title, ylabel='rms error of the force')
        ax.legend(fontsize=7)
    if options.out:
        figure.savefig(options.out, dpi=120)

if __name__ == '__main__':
    main()

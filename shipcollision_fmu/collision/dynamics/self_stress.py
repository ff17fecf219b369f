"""Friction of a patch without self-stress, as it is shown of contact points.

Several contacts of two bodies that stick can pull against each other, by friction impulses T_k that move no ship. The
law of contact leaves such self-stress open, and a solver ends with some. What is shown, and issued, is

    min  sum |T_k|^2 / N_k      with the changes of both twists as solved,  N_k: normal impulse         [N s]

so that each contact takes friction by its load. Where this leaves the cone |T_k| <= mu N_k of a contact, the split lies
as far as the cones allow on the way from the solved one to it. Contacts that slide keep their friction, which the law
determines.

In 6 degrees of freedom the sum and the moment of T_k stay as they are. In 3 and 4 the held motions take what the split
leaves of a moment about them, so the impulses issued change there, and no motion does.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot, sqrt

import numpy as np

from ...ship.frames import Array
from .body_state import BodyState
from .contact import Contact, Impulse, mean_velocity

__all__ = ["remove_self_stress"]

STILL = 1e-7
"""Slip [m/s] after the impulses that counts as none. With zero, the residual of the solver would count as sliding, and
self-stress at the edge of the cone would be shown; with a speed at which ships move, sliding friction would be
redistributed."""

RANK = 1e-12
"""Share of the largest singular value below which a combination of friction impulses moves no ship. Larger: motions of
a heavy ship beside a boat would count as none."""

ROUNDING = 1e-9
"""Share of the impulse below which the change of what is issued is rounding. With zero, it would be booked in every
substep, also of ships of which no motion is held."""


def remove_self_stress(impulses: Sequence[Impulse], states: Sequence[BodyState], mu: float) -> list[Impulse]:
    """The impulses, with the friction of every patch of sticking contacts split anew.

    states: after the impulses have been booked; what the held motions no longer take is booked. mu: friction of the
    pair. Normal impulses stay as they are.
    """
    shown = list(impulses)
    if mu == 0.0 or len(shown) < 2:
        return shown
    patches: dict[tuple[int, int], list[int]] = {}
    for k, impulse in enumerate(shown):
        c = impulse.contact
        patches.setdefault((c.a, c.b), []).append(k)
    for members in patches.values():
        if len(members) < 2:
            continue
        sticking = [k for k in members if _is_sticking(shown[k], states)]
        if len(sticking) > 1:
            solved = [shown[k] for k in sticking]
            split = _split_anew(solved, states, mu)
            for k, P in zip(sticking, split, strict=True):
                shown[k] = Impulse(shown[k].contact, P)
            _book_change(solved, split, states)
    return shown


def _book_change(solved: Sequence[Impulse], split: Sequence[Array], states: Sequence[BodyState]) -> None:
    """Book the difference of the impulses on either body, unless it is rounding: no motion is held then."""
    for body, sign, of_body in ((solved[0].contact.a, -1.0, "G_a"), (solved[0].contact.b, 1.0, "G_b")):
        G = np.concatenate([getattr(i.contact, of_body) for i in solved])
        change = np.concatenate([P - i.P for P, i in zip(split, solved, strict=True)]) @ G
        whole = np.abs(np.concatenate([i.P for i in solved])) @ np.abs(G)
        if not states[body].fixed and (np.abs(change) > ROUNDING * whole).any():
            states[body].book([sign * change])


def _is_sticking(impulse: Impulse, states: Sequence[BodyState]) -> bool:
    """Whether a contact has a load, and does not slip under it."""
    c = impulse.contact
    if float(impulse.P @ c.normal) <= 0.0:
        return False
    _, v_1, v_2 = (c.axes @ mean_velocity(c, states)).tolist()
    return hypot(v_1, v_2) <= STILL


def _split_anew(impulses: Sequence[Impulse], states: Sequence[BodyState], mu: float) -> list[Array]:
    """Impulses P (3,) in n of a patch, with friction that moves the bodies alike and the least sum |T_k|^2 / N_k."""
    contacts = [impulse.contact for impulse in impulses]
    in_axes = np.array([i.contact.axes @ i.P for i in impulses])
    N, T = in_axes[:, 0], in_axes[:, 1:].ravel()
    root = np.repeat(np.sqrt(N), 2)
    if not T[1::2].any():
        root[1::2] = 0.0  # friction in one direction stays in it
    _, size, V = np.linalg.svd(_twists_of_friction(contacts, states) * root, full_matrices=False)
    V = V[size > RANK * size[0]]
    least = root * (V.T @ (V @ np.divide(T, root, out=np.zeros_like(T), where=root > 0.0)))
    T = T + _largest_share(T, least, mu, N.tolist()) * (least - T)
    return [
        n * c.normal + t_1 * c.axes[1] + t_2 * c.axes[2]
        for c, n, (t_1, t_2) in zip(contacts, N.tolist(), T.reshape(-1, 2).tolist(), strict=True)
    ]


def _twists_of_friction(contacts: Sequence[Contact], states: Sequence[BodyState]) -> Array:
    """Changes of the twists of the bodies that can move, per friction impulse (t1, t2) of k contacts; (6 or 12, 2k).
    Rates are multiplied by the largest arm, to be velocities as well."""
    rows = []
    for body, of_body in ((contacts[0].a, "G_a"), (contacts[0].b, "G_b")):
        if states[body].fixed:
            continue
        G = np.concatenate([c.axes[1:] @ getattr(c, of_body) for c in contacts])
        change = states[body].M_inverse @ G.T
        change[3:] *= max(1.0, float(np.abs(G[:, 3:]).max()))
        rows.append(change)
    return np.concatenate(rows)


def _largest_share(T: Array, least: Array, mu: float, N: Sequence[float]) -> float:
    """Largest s up to 1 for which T + s (least - T) stays in every cone, or where T is outside, no farther outside."""
    share = 1.0
    for n, (a, b), (c, d) in zip(N, T.reshape(-1, 2).tolist(), least.reshape(-1, 2).tolist(), strict=True):
        limit = max(mu * n, hypot(a, b))
        if hypot(c, d) > limit:
            # |T + s D| = limit:  s^2 D.D + 2 s T.D + T.T - limit^2 = 0
            d_1, d_2 = c - a, d - b
            dd, td, rest = d_1 * d_1 + d_2 * d_2, a * d_1 + b * d_2, a * a + b * b - limit * limit
            share = min(share, max(0.0, (-td + sqrt(max(0.0, td * td - dd * rest))) / dd))
    return share

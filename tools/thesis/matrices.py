# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""How far a printed 4 x 4 matrix is from another."""
import math


def rotation_between(a, b):
    """The angle between two rotations [rad].

    Printed with three digits they are rotations to 0.001 only: the sine, from the antisymmetric part,
    is right to that, where the cosine alone would turn 0.001 into two degrees."""
    turn = [[sum(b[i][k] * a[j][k] for k in range(3)) for j in range(3)] for i in range(3)]
    sine = math.hypot(turn[2][1] - turn[1][2], turn[0][2] - turn[2][0], turn[1][0] - turn[0][1]) / 2
    cosine = (turn[0][0] + turn[1][1] + turn[2][2] - 1) / 2
    return math.atan2(sine, cosine)


def shift_between(a, b):
    """The distance between two translations, in their unit."""
    return math.dist([row[3] for row in a[:3]], [row[3] for row in b[:3]])

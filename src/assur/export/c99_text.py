"""The parts of C99 files that are the same in all of them: head, roots of polynomials, a main that tests; names."""

import re

TAKEN = """auto break case char const continue default do double else enum extern float for goto if inline int long
    register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while
    HUGE_VAL HUGE_VALF HUGE_VALL INFINITY NAN"""
"""Keywords of C99, and macros of math.h that are no functions: a dimension of a file may have such a name."""


def identifier(name: str) -> str:
    """A name as C allows it; different names of a file stay different.

    >>> identifier("my-robot.2"), identifier("3rpr"), identifier("short"), identifier("short_")
    ('my_robot_2', 'm3rpr', 'short_', 'short__')
    """
    plain = re.sub(r"\W", "_", name, flags=re.ASCII)
    plain = plain if re.match(r"[A-Za-z]", plain) else f"m{plain}"
    return f"{plain}_" if plain.rstrip("_") in TAKEN.split() else plain


HEAD = """\
/* {title}
 *
 * Direct and inverse problem from a closed form, in C99; nothing is allocated, link with -lm. Lengths are in {unit},
 * angles in rad. Each function fills an array with the real solutions and returns their number; a negative number is
 * an error. Jp v = Jq dq holds rates v of the pose and dq of the inputs.
 *
 * inputs: {inputs}
 * pose: {pose}
{margins}
 */
#include <math.h>

#define {upper}_NOT_FINITE (-1) /* what is given is no number, or larger than 1e60 */
#define {upper}_VANISHES (-2) /* the polynomial vanishes: infinitely many solutions, or its roots were not found */
#define {upper}_UNDECIDED (-3) /* formulas degenerate, or roots are too near each other to tell how many there are */
{defines}

typedef struct {{
{parameters}
}} {name}_parameters;

extern const {name}_parameters {name}_dimensions;
const {name}_parameters {name}_dimensions = {{{values}}};

typedef struct {{
    double pose[{upper}_COORDINATES];
    double inputs[{upper}_INPUTS];
    double jp[{upper}_ROWS][{upper}_COORDINATES];
    double jq[{upper}_ROWS][{upper}_INPUTS];
    double margins[{upper}_MARGINS];
    double factors[{upper}_FACTORS];
    int signs[{upper}_SIGNS];
}} {name}_solution;
"""

POLYNOMIAL = r"""
#define MOST_ROOTS 16
#define TOO_NEAR 1e-4 /* of two roots, per their size: digits that coefficients lose where roots are double */

/* Horner, with the derivative: of p at x + i y, the real and imaginary parts of p and p'. */
static void horner(const double *c, int degree, double x, double y, double *value, double *slope)
{
    double a = c[degree], b = 0.0, da = 0.0, db = 0.0;
    for (int k = degree - 1; k >= 0; k--) {
        double ta = da * x - db * y + a, tb = da * y + db * x + b;
        da = ta;
        db = tb;
        ta = a * x - b * y + c[k];
        tb = a * y + b * x;
        a = ta;
        b = tb;
    }
    value[0] = a;
    value[1] = b;
    slope[0] = da;
    slope[1] = db;
}

/* Real roots of c[0] + c[1] t + ..., rising, by Aberth's iteration; as angles 2 atan(t) where asked, a leading
 * coefficient that vanishes being a root at pi. Their number, -1 where the polynomial vanishes or is no number, -2
 * where two roots are so near each other that rounding may decide whether they are real. */
static int polynomial_roots(const double *given, int most, int angle, double *out)
{
    double c[MOST_ROOTS + 1], x[MOST_ROOTS], y[MOST_ROOTS], size = 0.0, radius = 0.0;
    int degree = most, count = 0;
    for (int k = 0; k <= most; k++) {
        if (!isfinite(given[k])) return -1;
        size = fmax(size, fabs(given[k]));
    }
    if (size == 0.0) return -1;
    for (int k = 0; k <= most; k++) c[k] = given[k] / size;
    while (degree > 0 && fabs(c[degree]) < 1e-15) degree--;
    for (int k = 0; k < degree; k++)
        radius = fmax(radius, pow(fabs(c[k] / c[degree]), 1.0 / (degree - k)));
    for (int k = 0; k < degree; k++) {
        x[k] = 0.7 * radius * cos(6.283185307179586 * k / degree + 0.4);
        y[k] = 0.7 * radius * sin(6.283185307179586 * k / degree + 0.4);
    }
    for (int round = 0; round < 200; round++) {
        double moved = 0.0;
        for (int k = 0; k < degree; k++) {
            double p[2], d[2], ra, rb, sa = 0.0, sb = 0.0, na, nb, norm;
            horner(c, degree, x[k], y[k], p, d);
            norm = d[0] * d[0] + d[1] * d[1];
            if (norm == 0.0 || (p[0] == 0.0 && p[1] == 0.0)) continue;
            ra = (p[0] * d[0] + p[1] * d[1]) / norm;
            rb = (p[1] * d[0] - p[0] * d[1]) / norm;
            for (int j = 0; j < degree; j++) {
                double u = x[k] - x[j], v = y[k] - y[j], w = u * u + v * v;
                if (j == k || w == 0.0) continue;
                sa += u / w;
                sb -= v / w;
            }
            na = 1.0 - (ra * sa - rb * sb);
            nb = -(ra * sb + rb * sa);
            norm = na * na + nb * nb;
            if (norm == 0.0) continue;
            u_step:;
            double ua = (ra * na + rb * nb) / norm, ub = (rb * na - ra * nb) / norm;
            x[k] -= ua;
            y[k] -= ub;
            moved = fmax(moved, hypot(ua, ub) / (hypot(x[k], y[k]) + 1e-300));
        }
        if (moved < 1e-15) break;
    }
    for (int k = 0; k < degree; k++) {
        double p[2], d[2], t = x[k];
        double own = 1e-3 * radius + hypot(x[k], y[k]), near = TOO_NEAR * own;
        for (int j = 0; j < degree; j++)
            if (j != k && fabs(y[k]) <= near && hypot(x[k] - x[j], y[k] - y[j]) <= near) return -2;
        if (!(fabs(y[k]) <= 1e-7 * own)) continue;
        for (int round = 0; round < 3; round++) {
            horner(c, degree, t, 0.0, p, d);
            if (d[0] == 0.0 || !(fabs(p[0] / d[0]) <= 1e-6 * (fabs(t) + 1e-3 * radius))) break;
            t -= p[0] / d[0];
        }
        out[count++] = angle ? 2.0 * atan(t) : t;
    }
    if (angle)
        for (int k = degree; k < most; k++) out[count++] = 3.141592653589793;
    for (int k = 1; k < count; k++)
        for (int j = k; j > 0 && out[j] < out[j - 1]; j--) {
            double t = out[j];
            out[j] = out[j - 1];
            out[j - 1] = t;
        }
    return count;
}
""".replace("            u_step:;\n", "")

LEFT_OVER = """
/* What vanishes at a root: its coefficients lose digits where roots lie together. */
static double {name}_left_over(const {name}_parameters *p, const double *given, const double *sign, double root)
{{
    double value;
    (void)p; (void)given; (void)sign;
{body}
    return value;
}}

/* A root of the coefficients, by Newton's steps that make the above smaller. */
static double {name}_nearer(const {name}_parameters *p, const double *given, const double *sign, double root)
{{
    double value = {name}_left_over(p, given, sign, root);
    for (int round = 0; round < 4; round++) {{
        double slope = ({name}_left_over(p, given, sign, root + 1e-7) - value) / 1e-7;
        double moved = root - value / slope, smaller;
        if (!(fabs(moved - root) <= 1e-3)) break;
        smaller = {name}_left_over(p, given, sign, moved);
        if (!(fabs(smaller) < fabs(value))) break;
        root = moved;
        value = smaller;
    }}
    return root;
}}
"""

SELF_TEST = """
#ifdef {upper}_TEST
#include <stdio.h>

static int near(const double *own, const double *expected, int size)
{{
    for (int k = 0; k < size; k++)
        if (!(fabs(own[k] - expected[k]) <= 1e-9 * {scale})) return 0;
    return 1;
}}

int main(void)
{{
    int wrong = 0;
{tests}
    printf("{name}: %s\\n", wrong ? "WRONG" : "fine");
    return wrong != 0;
}}
#endif
"""

/* The yardstick of bench.py: the closed form of zeng2019 as one would write it by hand in C, fused, for speed.
 *
 * Letters as in src/assur/mechanisms/zeng2019/closed_form.py. Every component is an array of its own (structure of
 * arrays), every pose is read once, every number is written once, no memory is allocated. The determinants are the
 * factored ones. The lengths and tolerances that do not change are worked out before the loop; the compiler
 * vectorises the loops (-O3 -march=native, -fno-math-errno and -fno-trapping-math so that sqrt and max can be).
 * `limit` holds the margins' tolerances: a branch exists where margin >= -limit, and not where |B| <= limit.
 */
#include <stdint.h>
#include <string.h>

#define STRIP 512 /* poses per strip where an answer has many rows (256, 512 and 1024 measured: within 10 %) */

typedef struct { double b, d, l1, l2, l3, l4, l6, l7, l8; } lengths;
typedef struct { double n_alpha, n_beta, m12, m3; } inverse_limits;
typedef struct { double big_b, w2, v2, centres, meeting; } direct_limits;

static inline double root(double radicand) { return __builtin_sqrt(radicand > 0 ? radicand : 0.0); }
static inline double magnitude(double number) { return __builtin_fabs(number); }

/* One working mode: three inputs, validity, det Jp, det Jq, nine factors. */
void inverse_one(long n, const lengths *p, const inverse_limits *limit, const double *mode,
                 const double *restrict x, const double *restrict y, const double *restrict z,
                 double *restrict y1, double *restrict y2, double *restrict y3, uint8_t *restrict exists,
                 double *restrict det_jp, double *restrict det_jq,
                 double *restrict f_u12, double *restrict f_w, double *restrict f_v, double *restrict f_sin_ab,
                 double *restrict f_u1, double *restrict f_u2, double *restrict f_u3,
                 double *restrict f_sin_a, double *restrict f_sin_b)
{
    const double width = p->b - p->d, per_l4 = 1 / p->l4, per_l6 = 1 / p->l6, half = p->l3 / 2;
    const double l2l2 = p->l2 * p->l2, l6l6 = p->l6 * p->l6, l4 = p->l4, l6 = p->l6;
    const double low1 = p->l1, low3 = p->l1 + p->l7 + p->l8;
    const double sa = mode[0], sb = mode[1], s1 = mode[2], s2 = mode[3], s3 = mode[4];
    const double no_alpha = -limit->n_alpha, no_beta = -limit->n_beta, no12 = -limit->m12, no3 = -limit->m3;
    for (long i = 0; i < n; i++) {
        const double cos_a = (x[i] + width) * per_l4, cos_b = (x[i] - width) * per_l6;
        const double n_alpha = 1 - cos_a * cos_a, n_beta = 1 - cos_b * cos_b;
        const double sin_a = sa * root(n_alpha), sin_b = sb * root(n_beta);
        const double w = z[i] - l4 * sin_a - low1, v = z[i] - l6 * sin_b - low3;
        const double m12 = l2l2 - w * w, m3 = l6l6 - v * v;
        const double root12 = root(m12), u1 = s1 * root12, u2 = s2 * root12, u3 = s3 * root(m3);
        const double u12 = u1 - u2, sin_ab = cos_b * sin_a - sin_b * cos_a;
        y1[i] = y[i] + half - u1;
        y2[i] = y[i] - half - u2;
        y3[i] = y[i] - u3;
        exists[i] = (n_alpha >= no_alpha) & (n_beta >= no_beta) & (m12 >= no12) & (m3 >= no3);
        det_jp[i] = u12 * w * v * sin_ab;
        det_jq[i] = u1 * u2 * u3 * sin_a * sin_b;
        f_u12[i] = u12;
        f_w[i] = w;
        f_v[i] = v;
        f_sin_ab[i] = sin_ab;
        f_u1[i] = u1;
        f_u2[i] = u2;
        f_u3[i] = u3;
        f_sin_a[i] = sin_a;
        f_sin_b[i] = sin_b;
    }
}

/* The twelve numbers that the 32 inverses are made of, and the four validities they depend on.
 * Rows y1_0..3 are [s_alpha][u1], y2 [s_alpha][u2], y3 [s_beta][u3], ok [s_alpha][s_beta]; plus before minus.
 * A restricted pointer for each row, so that the compiler need not ask whether rows overlap. */
static void twelve(long n, const lengths *p, const inverse_limits *limit,
                   const double *restrict x, const double *restrict y, const double *restrict z,
                   double *restrict y1_0, double *restrict y1_1, double *restrict y1_2, double *restrict y1_3,
                   double *restrict y2_0, double *restrict y2_1, double *restrict y2_2, double *restrict y2_3,
                   double *restrict y3_0, double *restrict y3_1, double *restrict y3_2, double *restrict y3_3,
                   uint8_t *restrict ok_0, uint8_t *restrict ok_1, uint8_t *restrict ok_2, uint8_t *restrict ok_3)
{
    const double width = p->b - p->d, per_l4 = 1 / p->l4, per_l6 = 1 / p->l6, half = p->l3 / 2;
    const double l2l2 = p->l2 * p->l2, l6l6 = p->l6 * p->l6, l4 = p->l4, l6 = p->l6;
    const double low1 = p->l1, low3 = p->l1 + p->l7 + p->l8;
    const double no_alpha = -limit->n_alpha, no_beta = -limit->n_beta, no12 = -limit->m12, no3 = -limit->m3;
    for (long i = 0; i < n; i++) {
        const double cos_a = (x[i] + width) * per_l4, cos_b = (x[i] - width) * per_l6;
        const double n_alpha = 1 - cos_a * cos_a, n_beta = 1 - cos_b * cos_b;
        const double high_a = l4 * root(n_alpha), high_b = l6 * root(n_beta);
        const double w_up = z[i] - low1 - high_a, w_down = z[i] - low1 + high_a;
        const double v_up = z[i] - low3 - high_b, v_down = z[i] - low3 + high_b;
        const double m12_up = l2l2 - w_up * w_up, m12_down = l2l2 - w_down * w_down;
        const double m3_up = l6l6 - v_up * v_up, m3_down = l6l6 - v_down * v_down;
        const double r_up = root(m12_up), r_down = root(m12_down), t_up = root(m3_up), t_down = root(m3_down);
        const double left = y[i] + half, right = y[i] - half;
        const int x_fits = (n_alpha >= no_alpha) & (n_beta >= no_beta);
        y1_0[i] = left - r_up;
        y1_1[i] = left + r_up;
        y1_2[i] = left - r_down;
        y1_3[i] = left + r_down;
        y2_0[i] = right - r_up;
        y2_1[i] = right + r_up;
        y2_2[i] = right - r_down;
        y2_3[i] = right + r_down;
        y3_0[i] = y[i] - t_up;
        y3_1[i] = y[i] + t_up;
        y3_2[i] = y[i] - t_down;
        y3_3[i] = y[i] + t_down;
        ok_0[i] = x_fits & (m12_up >= no12) & (m3_up >= no3);
        ok_1[i] = x_fits & (m12_up >= no12) & (m3_down >= no3);
        ok_2[i] = x_fits & (m12_down >= no12) & (m3_up >= no3);
        ok_3[i] = x_fits & (m12_down >= no12) & (m3_down >= no3);
    }
}

void inverse_distinct(long n, const lengths *p, const inverse_limits *limit,
                      const double *restrict x, const double *restrict y, const double *restrict z,
                      double *restrict y1, double *restrict y2, double *restrict y3, uint8_t *restrict exists)
{
    twelve(n, p, limit, x, y, z, y1, y1 + n, y1 + 2 * n, y1 + 3 * n, y2, y2 + n, y2 + 2 * n, y2 + 3 * n,
           y3, y3 + n, y3 + 2 * n, y3 + 3 * n, exists, exists + n, exists + 2 * n, exists + 3 * n);
}

/* All 32: inputs[mode][slider][pose], exists[mode][pose], the last sign of the mode running fastest. */
void inverse_expanded(long n, const lengths *p, const inverse_limits *limit,
                      const double *restrict x, const double *restrict y, const double *restrict z,
                      double *restrict inputs, uint8_t *restrict exists)
{
    double y1[4][STRIP], y2[4][STRIP], y3[4][STRIP];
    uint8_t valid[4][STRIP];
    for (long start = 0; start < n; start += STRIP) {
        const long count = n - start < STRIP ? n - start : STRIP;
        twelve(count, p, limit, x + start, y + start, z + start, y1[0], y1[1], y1[2], y1[3], y2[0], y2[1], y2[2], y2[3],
               y3[0], y3[1], y3[2], y3[3], valid[0], valid[1], valid[2], valid[3]);
        for (int mode = 0; mode < 32; mode++) {
            const int sa = mode >> 4 & 1, sb = mode >> 3 & 1, s1 = mode >> 2 & 1, s2 = mode >> 1 & 1, s3 = mode & 1;
            double *row = inputs + 3 * mode * n + start;
            memcpy(row, y1[2 * sa + s1], count * sizeof(double));
            memcpy(row + n, y2[2 * sa + s2], count * sizeof(double));
            memcpy(row + 2 * n, y3[2 * sb + s3], count * sizeof(double));
            memcpy(exists + mode * n + start, valid[2 * sa + sb], count);
        }
    }
}

/* Eight directs of one strip, first what they share: y, the two roots, and whether those exist. */
static void direct_shared(long n, const lengths *p, const direct_limits *limit,
                          const double *restrict y1, const double *restrict y2, const double *restrict y3,
                          double *restrict y, double *restrict w, double *restrict v, double *restrict fits)
{
    const double l2l2 = p->l2 * p->l2, l6l6 = p->l6 * p->l6, l3 = p->l3;
    const double no_b = limit->big_b, no_w = -limit->w2, no_v = -limit->v2;
    for (long i = 0; i < n; i++) {
        const double big_b = y1[i] - l3 - y2[i], middle = (y1[i] + y2[i]) / 2, u3 = middle - y3[i];
        const double w2 = l2l2 - big_b * big_b / 4, v2 = l6l6 - u3 * u3;
        y[i] = middle;
        w[i] = root(w2);
        v[i] = root(v2);
        fits[i] = (magnitude(big_b) > no_b) & (w2 >= no_w) & (v2 >= no_v) ? 1.0 : 0.0;
    }
}

/* Then, for each sign of w and of v, the two meeting points of the circles about D1 and D3. */
static void direct_pair(long n, const lengths *p, const direct_limits *limit, double s1, double s2,
                        const double *restrict w_root, const double *restrict v_root, const double *restrict fits,
                        double *restrict x_plus, double *restrict z_plus, uint8_t *restrict plus,
                        double *restrict x_minus, double *restrict z_minus, uint8_t *restrict minus)
{
    const double l78 = p->l7 + p->l8, low = p->l1, differ = p->l6 * p->l6 - p->l4 * p->l4, four = 4 * p->l4 * p->l4;
    const double width = 2 * (p->b - p->d), middle = width / 2, width2 = width * width;
    const double no_centres = limit->centres, no_meeting = -limit->meeting;
    for (long i = 0; i < n; i++) {
        const double w = s1 * w_root[i], v = s2 * v_root[i];
        const double t = v + l78 - w, centres = width2 + t * t, j3 = differ - centres;
        const double meeting = four * centres - j3 * j3, half = root(meeting), per = 0.5 / centres;
        const double x0 = -j3 * width * per - middle, z0 = low + w - j3 * t * per;
        const double dx = half * t * per, dz = half * width * per;
        const uint8_t met = (fits[i] > 0.5) & (centres > no_centres) & (meeting >= no_meeting);
        x_plus[i] = x0 - dx;
        z_plus[i] = z0 + dz;
        x_minus[i] = x0 + dx;
        z_minus[i] = z0 - dz;
        plus[i] = met;
        minus[i] = met;
    }
}

/* All eight directs: poses[mode][coordinate][pose], exists[mode][pose]; the signs are e1, e2, e3. */
void direct_all(long n, const lengths *p, const direct_limits *limit,
                const double *restrict y1, const double *restrict y2, const double *restrict y3,
                double *restrict poses, uint8_t *restrict exists)
{
    double y[STRIP], w[STRIP], v[STRIP], fits[STRIP];
    for (long start = 0; start < n; start += STRIP) {
        const long count = n - start < STRIP ? n - start : STRIP;
        direct_shared(count, p, limit, y1 + start, y2 + start, y3 + start, y, w, v, fits);
        for (int pair = 0; pair < 4; pair++) {
            double *plus = poses + 6 * pair * n + start, *minus = plus + 3 * n;
            uint8_t *valid = exists + 2 * pair * n + start;
            direct_pair(count, p, limit, pair & 2 ? -1 : 1, pair & 1 ? -1 : 1, w, v, fits,
                        plus, plus + 2 * n, valid, minus, minus + 2 * n, valid + n);
            memcpy(plus + n, y, count * sizeof(double));
            memcpy(minus + n, y, count * sizeof(double));
        }
    }
}

// SPDX-License-Identifier: Apache-2.0
#include "core/deform/rotations.h"

namespace nt {
namespace {

// K = R S.
Matrix4x product(const Matrix4x& r, const Matrix4x& s) {
  Matrix4x k;
  for (int row = 0; row < 3; ++row) {
    for (int col = 0; col < 3; ++col) {
      k.m[3 * row + col] = r.m[3 * row] * s.m[col] + r.m[3 * row + 1] * s.m[3 + col] + r.m[3 * row + 2] * s.m[6 + col];
    }
  }
  return k;
}

struct Step {
  Float4 x, y, z;     // omega
  Float4 minor, det;  // leading minors of B, positive where the step goes uphill to a maximum
  Float4 bxx;
};

Step newton_step(const Matrix4x& k) {
  const Float4 half = splat4(0.5f);
  const Float4 bxx = k.m[4] + k.m[8], byy = k.m[0] + k.m[8], bzz = k.m[0] + k.m[4];
  const Float4 bxy = splat4(0.0f) - half * (k.m[1] + k.m[3]), bxz = splat4(0.0f) - half * (k.m[2] + k.m[6]),
               byz = splat4(0.0f) - half * (k.m[5] + k.m[7]);
  const Float4 gx = k.m[5] - k.m[7], gy = k.m[6] - k.m[2], gz = k.m[1] - k.m[3];
  const Float4 cxx = byy * bzz - byz * byz, cxy = bxz * byz - bxy * bzz, cxz = bxy * byz - byy * bxz;
  const Float4 cyy = bxx * bzz - bxz * bxz, cyz = bxy * bxz - bxx * byz, czz = bxx * byy - bxy * bxy;
  const Float4 det = bxx * cxx + bxy * cxy + bxz * cxz;
  const Float4 inverse = splat4(1.0f) / det;
  return {inverse * (cxx * gx + cxy * gy + cxz * gz),
          inverse * (cxy * gx + cyy * gy + cyz * gz),
          inverse * (cxz * gx + cyz * gy + czz * gz),
          czz,
          det,
          bxx};
}

// q <- (1, omega / 2) q, normalised: a turn of 2 atan(|omega| / 2), which is omega to the third order.
void turn(const Step& s, Quat4& q) {
  const Float4 half = splat4(0.5f);
  const Float4 x = half * s.x, y = half * s.y, z = half * s.z;
  const Quat4 p{q.w - x * q.x - y * q.y - z * q.z, q.x + x * q.w + y * q.z - z * q.y, q.y + y * q.w + z * q.x - x * q.z,
                q.z + z * q.w + x * q.y - y * q.x};
  const Float4 scale = splat4(1.0f) / sqrt4(p.w * p.w + p.x * p.x + p.y * p.y + p.z * p.z);
  q = {p.w * scale, p.x * scale, p.y * scale, p.z * scale};
}

// One Jacobi rotation that makes a[p][q] zero; v collects the eigenvectors as columns.
void jacobi_rotate(double a[4][4], double v[4][4], int p, int q) {
  if (a[p][q] == 0.0) return;
  const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
  const double magnitude = theta < 0.0 ? -theta : theta;
  const double t = (theta < 0.0 ? -1.0 : 1.0) / (magnitude + det::sqrt(theta * theta + 1.0));
  const double c = 1.0 / det::sqrt(t * t + 1.0), s = t * c;
  for (int k = 0; k < 4; ++k) {
    const double kp = a[k][p], kq = a[k][q];
    a[k][p] = c * kp - s * kq, a[k][q] = s * kp + c * kq;
  }
  for (int k = 0; k < 4; ++k) {
    const double pk = a[p][k], qk = a[q][k];
    a[p][k] = c * pk - s * qk, a[q][k] = s * pk + c * qk;
  }
  for (int k = 0; k < 4; ++k) {
    const double kp = v[k][p], kq = v[k][q];
    v[k][p] = c * kp - s * kq, v[k][q] = s * kp + c * kq;
  }
}

}  // namespace

Matrix4x matrices(const Quat4& q) {
  const Float4 one = splat4(1.0f), two = splat4(2.0f);
  const Float4 xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z, xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
  const Float4 wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  return {{one - two * (yy + zz), two * (xy - wz), two * (xz + wy),  //
           two * (xy + wz), one - two * (xx + zz), two * (yz - wx),  //
           two * (xz - wy), two * (yz + wx), one - two * (xx + yy)}};
}

bool newton_rotations(const Matrix4x& s, int steps, Quat4& q) {
  constexpr float kShort = 1e-5f;  // of omega^2: what a further step would do is less than a float's last digit
  bool doubtful = false;
  for (int i = 0; i < steps; ++i) {
    const Step step = newton_step(product(matrices(q), s));
    const Float4 size = step.x * step.x + step.y * step.y + step.z * step.z;
    Quat4 turned = q;
    turn(step, turned);
    // Written so that NaN counts as doubtful.
    const float most = i + 1 == steps ? 0.01f : 1.0f;
    bool safe = true, done = true;
    for (int lane = 0; lane < 4; ++lane) {
      safe = safe & (step.bxx[lane] > 0.0f) & (step.minor[lane] > 0.0f) & (step.det[lane] > 0.0f) & (size[lane] < most);
      done = done & (size[lane] < kShort);
    }
    if (!safe) {
      doubtful = true;
      break;
    }
    q = turned;
    if (done) break;
  }
  return doubtful;
}

Quat best_rotation(const float s[9]) {
  const double xx = s[0], xy = s[1], xz = s[2], yx = s[3], yy = s[4], yz = s[5], zx = s[6], zy = s[7], zz = s[8];
  double a[4][4] = {{xx + yy + zz, yz - zy, zx - xz, xy - yx},
                    {yz - zy, xx - yy - zz, xy + yx, zx + xz},
                    {zx - xz, xy + yx, yy - xx - zz, yz + zy},
                    {xy - yx, zx + xz, yz + zy, zz - xx - yy}};
  double v[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  for (int sweep = 0; sweep < 12; ++sweep) {
    double off = 0.0, on = 0.0;
    for (int i = 0; i < 4; ++i) {
      on += a[i][i] * a[i][i];
      for (int j = i + 1; j < 4; ++j) off += a[i][j] * a[i][j];
    }
    if (!(off > 1e-28 * on)) break;
    for (int p = 0; p < 3; ++p) {
      for (int r = p + 1; r < 4; ++r) jacobi_rotate(a, v, p, r);
    }
  }
  int best = 0;
  for (int i = 1; i < 4; ++i) best = a[i][i] > a[best][best] ? i : best;
  return normalised(Quat{static_cast<float>(v[0][best]), static_cast<float>(v[1][best]), static_cast<float>(v[2][best]),
                         static_cast<float>(v[3][best])});
}

}  // namespace nt

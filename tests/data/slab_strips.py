"""Writes slab_strips.csv: scattering of thin slabs without end, lit across, by boundary integrals.

    /usr/bin/python3 tests/data/slab_strips.py > tests/data/slab_strips.csv

u is E (tm) or H (te) along the slab, lengths in wavelengths, e^{+jwt}; u_s ~ P sqrt(2/(pi k rho)) e^{-j(k rho - pi/4)}, phase
reference in the middle of a slab of |x| <= width/2, |y| <= thickness/2; angles from the x axis, towards source and observer. Equations
of the second kind (Mueller) on the real rectangle, Nystroem on panels graded to the corners, near ones split dyadically; finer panels
change P by less than 1e-4 of its peak, reciprocity 1e-7.
"""
import numpy as np
from scipy.special import hankel2, j0, j1, y0, y1

k0 = 2 * np.pi


def H01(k, R):
    if abs(np.imag(k)) == 0:
        z = np.real(k)*R
        return j0(z)-1j*y0(z), j1(z)-1j*y1(z)
    z = k*R
    return hankel2(0, z), hankel2(1, z)
def kern(k, rx, ry, nx, ny, mx, my):
    """S, D (d/dn'), A (d/dn), T (d2/dn dn'); r = target - source, n target normal, m source normal"""
    R = np.sqrt(rx*rx+ry*ry); h0, h1 = H01(k, R); c = 1/4j
    rn = (rx*nx+ry*ny)/R; rm = (rx*mx+ry*my)/R; kh = k*h1
    return c*h0, c*kh*rm, -c*kh*rn, c*(kh/R*(nx*mx+ny*my)+(k*k*h0-2*kh/R)*rn*rm)
class Boundary:
    def __init__(s, segs, p=10):
        """segs: list of (z0, z1, breaks in [0,1], tag); normal to the right of the direction z0->z1"""
        g, wt = np.polynomial.legendre.leggauss(p); s.p = p; s.g = g; s.wt = wt
        P = []
        for z0, z1, br, tag in segs:
            for a, b in zip(br[:-1], br[1:]): P.append((z0+(z1-z0)*a, z0+(z1-z0)*b, tag))
        s.a = np.array([q[0] for q in P]); s.b = np.array([q[1] for q in P]); s.ptag = np.array([q[2] for q in P])
        s.L = abs(s.b-s.a); t = (s.b-s.a)/s.L; s.t = t; s.pn = t*(-1j)
        s.z = (s.a[:, None]+(s.b-s.a)[:, None]*(g+1)/2).ravel(); s.W = (s.L[:, None]/2*wt).ravel()
        s.n = np.repeat(s.pn, p); s.tag = np.repeat(s.ptag, p); s.N = len(s.z)
        # Lagrange via Legendre
        V = np.polynomial.legendre.legvander(g, p-1); s.iV = np.linalg.inv(V)
    def near(s):
        z = s.z; c = (s.a+s.b)/2
        d = z[:, None]-c[None]
        xt = (d*np.conj(s.t)[None]).real; yt = (d*np.conj(s.t)[None]).imag
        dx = np.maximum(abs(xt)-s.L/2, 0); dist = np.hypot(dx, yt)
        m = dist < 1.2*s.L
        I, Pn = np.nonzero(m)
        t0 = np.clip(xt[I, Pn]/(s.L[Pn]/2), -1, 1); rel = dist[I, Pn]/s.L[Pn]
        return I, Pn, t0, rel
    def ops(s, ks):
        N = s.N; z = s.z; out = []
        rx = (z[:, None]-z[None]).real; ry = (z[:, None]-z[None]).imag
        np.fill_diagonal(rx, 1.0)
        nx, ny = s.n.real, s.n.imag
        M = [[q*s.W[None] for q in kern(k, rx, ry, nx[:, None], ny[:, None], nx[None], ny[None])] for k in ks]
        I, Pn, t0, rel = s.near()
        lev = np.clip(np.ceil(np.log2(1/np.maximum(rel, 2.0**-17)))+1, 2, 18).astype(int)
        gq, wq = np.polynomial.legendre.leggauss(8)
        p = s.p
        for L in np.unique(lev):
            sel = np.nonzero(lev == L)[0]
            e = np.concatenate([[0], 2.0**-np.arange(L, -1, -1)])
            xi = (e[:-1, None]+np.diff(e)[:, None]*(gq+1)/2).ravel(); wx = (np.diff(e)[:, None]/2*wq).ravel()
            for ch in np.array_split(sel, max(1, len(sel)*len(xi)*2//400000)):
                i, q, tt = I[ch], Pn[ch], t0[ch]
                T = np.concatenate([tt[:, None]-(tt[:, None]+1)*xi, tt[:, None]+(1-tt[:, None])*xi], 1)
                Wt = np.concatenate([(tt[:, None]+1)*wx, (1-tt[:, None])*wx], 1)*(s.L[q]/2)[:, None]
                # accurate offsets: target relative to source point along panel
                c = (s.a[q]+s.b[q])/2; d = (z[i]-c)*np.conj(s.t[q]); xt = d.real; yt = d.imag
                on = (s.n[i] == s.pn[q]) & (abs(yt) < 1e-13)
                yt = np.where(on, 0, yt)
                du = np.concatenate([(tt[:, None]+1)*xi, -(1-tt[:, None])*xi], 1)*(s.L[q]/2)[:, None]+(xt-tt*s.L[q]/2)[:, None]
                r = (du+1j*yt[:, None])*s.t[q][:, None]
                r = np.where(abs(r) < 1e-12, 1e-12*s.t[q][:, None], r)
                Lag = np.polynomial.legendre.legvander(T, p-1)@s.iV
                cols = q[:, None]*p+np.arange(p)
                for kk, k in enumerate(ks):
                    K4 = kern(k, r.real, r.imag, nx[i][:, None], ny[i][:, None], s.pn[q].real[:, None], s.pn[q].imag[:, None])
                    for o in range(4):
                        if o == 3: continue
                        f = K4[o]
                        if o in (1, 2): f = np.where(on[:, None], 0, f)
                        M[kk][o][i[:, None], cols] = np.einsum('ij,ijk->ik', f*Wt, Lag)
                    if kk == 0: T1 = K4[3]
                    else: M[1][3][i[:, None], cols] = 0; M[0][3][i[:, None], cols] = np.einsum('ij,ijk->ik', (T1-K4[3])*Wt, Lag)
        if len(ks) == 2:
            TD = M[0][3]-M[1][3]
        else: TD = M[0][3]
        return M, TD
    def rhs(s, phi):
        c, d = np.cos(phi), np.sin(phi); u = np.exp(1j*k0*(s.z.real*c+s.z.imag*d))
        return u, 1j*k0*(s.n.real*c+s.n.imag*d)*u
def graded(L, d, hmax, lv):
    """breaks on a side of length L graded dyadically to both ends from size d, panels <= hmax"""
    e = d*2.0**-np.arange(lv, -1, -1.0)           # d/2^lv .. d
    left = [0]+list(e[e < L/2*0.999])
    x = left[-1]
    while x < L/2-1e-12:
        st = min(hmax, max(x*1.0, 1e-9), ); 
        if x+1.4*st >= L/2: x = L/2
        else: x += st
        left.append(x)
    left = np.array(left); r = np.concatenate([left, (L-left)[::-1][1:]])
    return r/L
def slab(w, d, hmax=.2, lv=7, p=10):
    a, h = w/2, d/2
    bx = graded(w, d, hmax, lv); by = graded(d, d/4, hmax, max(lv-2, 2))
    # counterclockwise, normal to the right = outward
    return Boundary([(-a-1j*h, a-1j*h, bx, 0), (a-1j*h, a+1j*h, by, 1), (a+1j*h, -a+1j*h, bx, 2), (-a+1j*h, -a-1j*h, by, 1)], p)
def solve_slab(w, d, eps, mu, phis, phos, hmax=.2, lv=7, p=10):
    """returns {'tm': P[len(phis), :], 'te': ...}: phos None -> monostatic vector; else bistatic rows for each phi_i"""
    B = slab(w, d, hmax, lv, p); N = B.N
    k2 = k0*np.sqrt(complex(eps*mu)); k2 = k2 if k2.imag <= 0 else -k2
    if k2.imag == 0: k2 = k2.real
    (M1, M2), TD = B.ops([k0, k2])
    S1, D1, A1, _ = M1; S2, D2, A2, _ = M2
    R = [B.rhs(f) for f in phis]
    b = np.array([np.concatenate(r) for r in R]).T
    res = {}
    for pol, c in (('tm', mu), ('te', eps)):
        A = np.empty((2*N, 2*N), complex); E = np.eye(N)
        A[:N, :N] = E-(D1-D2); A[:N, N:] = S1-c*S2; A[N:, :N] = -TD; A[N:, N:] = .5*(1+c)*E+A1-c*A2
        X = np.linalg.solve(A, b)
        def P(x, fo):
            u, du = B.rhs(fo)
            return (1/4j)*np.sum((x[:N]*du-u*x[N:])*B.W)
        if phos is None: res[pol] = np.array([P(X[:, i], f) for i, f in enumerate(phis)])
        else: res[pol] = np.array([[P(X[:, i], f) for f in phos] for i in range(len(phis))])
    return res


if __name__ == "__main__":
    media = ((2.61 - 0.035j, 1.0), (4 - 0.1j, 1.0), (16.9 - 0.39j, 2.46 - 1.95j))
    steep = np.radians(np.arange(5, 91, 1.0))
    print("eps_re,eps_im,mu_re,mu_im,thickness,width,field,source_deg,observer_deg,re_p,im_p")
    for eps, mu in media:
        for thickness in (0.02, 0.05, 0.1):
            eps, mu = complex(eps), complex(mu)
            back = solve_slab(3.0, thickness, eps, mu, steep, None, 0.2, 4, 8)
            sources, observers = np.radians([20.0, 60.0]), np.radians(np.arange(-175, 181, 10.0))
            apart = solve_slab(3.0, thickness, eps, mu, sources, observers, 0.2, 4, 8)
            for field in ("tm", "te"):
                rows = [(a, a, p) for a, p in zip(steep, back[field])]
                rows += [(a, b, apart[field][i, j]) for i, a in enumerate(sources) for j, b in enumerate(observers)]
                for a, b, p in rows:
                    print(
                        f"{eps.real:g},{eps.imag:g},{mu.real:g},{mu.imag:g},{thickness:g},3,{field},"
                        f"{np.degrees(a):g},{np.degrees(b):g},{p.real:.6g},{p.imag:.6g}"
                    )

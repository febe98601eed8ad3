"""Every equation that a report can show, in typst's mathematics and in HTML; docs/rigid.md and docs/flexible.md derive
them."""

from __future__ import annotations

_BOX = '<span class="column">{}</span>'


def _lines(*lines: str) -> str:
    return _BOX.format("".join(f"<span>{line}</span>" for line in lines))


#: Name -> (typst, HTML).
EQUATIONS: dict[str, tuple[str, str]] = {
    "block": (
        r"m_y dot.double(y) &= P - m_y a + T \ m_z dot.double(z) &= N_h + N_t - N_0(t) \ "
        r"J dot.double(theta) &= M_0 + H T - B_h N_h + B_t N_t",
        _lines(
            "<i>m<sub>y</sub></i> ÿ = <i>P</i> − <i>m<sub>y</sub> a</i> + <i>T</i>",
            "<i>m<sub>z</sub></i> z̈ = <i>N<sub>h</sub></i> + <i>N<sub>t</sub></i> − <i>N</i><sub>0</sub>(<i>t</i>)",
            "<i>J</i> θ̈ = <i>M</i><sub>0</sub> + <i>H T</i> − <i>B<sub>h</sub> N<sub>h</sub></i> + "
            "<i>B<sub>t</sub> N<sub>t</sub></i>",
        ),
    ),
    "inclined": (
        r"M dot.double(q) = f(t) + G^top (T, N_h, N_t), quad q = (y, z, theta)",
        "<i>M</i> q̈ = <i>f</i>(<i>t</i>) + <i>G</i><sup>⊤</sup> (<i>T</i>, <i>N<sub>h</sub></i>, "
        "<i>N<sub>t</sub></i>), &emsp;<i>q</i> = (<i>y</i>, <i>z</i>, <i>θ</i>)",
    ),
    "finite": (
        r"M &= m mat(1, 0, p_1; 0, 1, p_2; p_1, p_2, p dot p) + J_c + m_w r r^top \ M dot.double(q) &= Q + "
        r"dot(theta)^2 (m (R rho, p dot R rho) + m_w r (e dot R rho_w)) + G^top (T, N_h, N_t)",
        _lines(
            "<i>M</i> = <i>m</i> [1 0 <i>p</i><sub>1</sub>; 0 1 <i>p</i><sub>2</sub>; <i>p</i><sub>1</sub> "
            "<i>p</i><sub>2</sub> <i>p</i>·<i>p</i>] + <i>J<sub>c</sub></i> + <i>m<sub>w</sub> r r</i><sup>⊤</sup>",
            "<i>M</i> q̈ = <i>Q</i> + θ̇² (<i>m</i> (<i>Rρ</i>, <i>p</i>·<i>Rρ</i>) + <i>m<sub>w</sub> r</i> "
            "(<i>e</i>·<i>Rρ<sub>w</sub></i>)) + <i>G</i><sup>⊤</sup> (<i>T</i>, <i>N<sub>h</sub></i>, "
            "<i>N<sub>t</sub></i>)",
        ),
    ),
    "contact": (
        r"s = y + H theta, quad g_h = z - B_h theta >= 0, quad g_t = z + B_t theta >= 0",
        "<i>s</i> = <i>y</i> + <i>Hθ</i>, &emsp;<i>g<sub>h</sub></i> = <i>z</i> − <i>B<sub>h</sub>θ</i> ≥ 0, "
        "&emsp;<i>g<sub>t</sub></i> = <i>z</i> + <i>B<sub>t</sub>θ</i> ≥ 0",
    ),
    "friction": (
        r"|T| <= mu_s N #text[ at rest], quad T = -mu_k N op(#text[sign]) dot(s) #text[ while it slides], quad "
        r"N = N_h + N_t, quad N_h, N_t >= 0",
        "|<i>T</i>| ≤ <i>μ<sub>s</sub> N</i> at rest, &emsp;<i>T</i> = −<i>μ<sub>k</sub> N</i> sign ṡ while it "
        "slides, &emsp;<i>N</i> = <i>N<sub>h</sub></i> + <i>N<sub>t</sub></i>, &emsp;<i>N<sub>h</sub></i>, "
        "<i>N<sub>t</sub></i> ≥ 0",
    ),
    "rough crack": (
        r"T = N tan(phi + i), quad T = N tan(phi - i), quad i = i_0 e^(-c W)",
        "<i>T</i> = <i>N</i> tan(<i>φ</i> + <i>i</i>), &emsp;<i>T</i> = <i>N</i> tan(<i>φ</i> − <i>i</i>), "
        "&emsp;<i>i</i> = <i>i</i><sub>0</sub> <i>e</i><sup>−<i>cW</i></sup>",
    ),
    "impact": (
        r"M (v_2 - v_1) = n_i p_i + n_j p_j + t p_T, quad n_i dot v_2 = -e n_i dot v_1",
        "<i>M</i> (<i>v</i><sub>2</sub> − <i>v</i><sub>1</sub>) = <i>n<sub>i</sub> p<sub>i</sub></i> + "
        "<i>n<sub>j</sub> p<sub>j</sub></i> + <i>t p<sub>T</sub></i>, "
        "&emsp;<i>n<sub>i</sub></i>·<i>v</i><sub>2</sub> = −<i>e n<sub>i</sub></i>·<i>v</i><sub>1</sub>",
    ),
    "rigid energy": (
        r"E(t) - E(0) = W_#text[input] - W_#text[friction] - W_#text[impact]",
        "<i>E</i>(<i>t</i>) − <i>E</i>(0) = <i>W</i><sub>input</sub> − <i>W</i><sub>friction</sub> − "
        "<i>W</i><sub>impact</sub>",
    ),
    "virtual mass": (
        r"m_w = 7 / 12 rho_w sqrt(D) h^(3 slash 2), quad #text[acting ] 0.4 h #text[ above the crack]",
        "<i>m<sub>w</sub></i> = (7/12) <i>ρ<sub>w</sub></i> √<i>D</i> <i>h</i><sup>3/2</sup>, &emsp;acting 0.4 "
        "<i>h</i> above the crack",
    ),
    "turning water": (
        r"J_w = 12 / 175 m_w h^2",
        "<i>J<sub>w</sub></i> = (12/175) <i>m<sub>w</sub> h</i><sup>2</sup>",
    ),
    "virtual mass along face": (
        r"m(eta) = 7 / 8 rho_w sqrt(D (D - eta))",
        "<i>m</i>(<i>η</i>) = (7/8) <i>ρ<sub>w</sub></i> √(<i>D</i> (<i>D</i> − <i>η</i>))",
    ),
    "sloped water": (r"r = 1 - psi / (90 degree)", "<i>r</i> = 1 − <i>ψ</i>/90°"),
    "modes": (
        r"dot.double(q) + c dot(q) + omega^2 q = f - gamma_x a(t) - gamma_z a_v (t) + Phi_c^top p",
        "q̈ + <i>c</i> q̇ + <i>ω</i>² <i>q</i> = <i>f</i> − <i>γ<sub>x</sub> a</i>(<i>t</i>) − <i>γ<sub>z</sub> "
        "a<sub>v</sub></i>(<i>t</i>) + <i>Φ<sub>c</sub></i><sup>⊤</sup> <i>p</i>",
    ),
    "rock": (
        r"M_r dot.double(u) + C_r dot(u) + K_r u = f_r - B^top p, quad C_r = (2 xi_r) / omega_r K_r + "
        r"C_#text[waves]",
        "<i>M<sub>r</sub></i> ü + <i>C<sub>r</sub></i> u̇ + <i>K<sub>r</sub> u</i> = <i>f<sub>r</sub></i> − "
        "<i>B</i><sup>⊤</sup> <i>p</i>, &emsp;<i>C<sub>r</sub></i> = (2<i>ξ<sub>r</sub></i>/<i>ω<sub>r</sub></i>) "
        "<i>K<sub>r</sub></i> + <i>C</i><sub>waves</sub>",
    ),
    "sound": (
        r"M_w dot.double(phi) + C_w dot(phi) + K_w phi = Q^top (dot(u) + v_g), quad p_w = -rho_w dot(phi)",
        "<i>M<sub>w</sub></i> φ̈ + <i>C<sub>w</sub></i> φ̇ + <i>K<sub>w</sub> φ</i> = <i>Q</i><sup>⊤</sup> (u̇ + "
        "<i>v<sub>g</sub></i>), &emsp;<i>p<sub>w</sub></i> = −<i>ρ<sub>w</sub></i> φ̇",
    ),
    "rayleigh": (
        r"c = a_0 + a_1 omega^2",
        "<i>c</i> = <i>a</i><sub>0</sub> + <i>a</i><sub>1</sub> <i>ω</i>²",
    ),
    "modal": (r"c = 2 xi omega", "<i>c</i> = 2 <i>ξ ω</i>"),
    "step": (
        r"v' - v &= -h (omega^2 (q + theta h v^*) + c v^*) + h f - gamma Delta V + Phi_c^top p \ q' - q &= h v^*, quad "
        r"v^* = theta v' + (1 - theta) v",
        _lines(
            "<i>v′</i> − <i>v</i> = −<i>h</i> (<i>ω</i>² (<i>q</i> + <i>θ h v*</i>) + <i>c v*</i>) + <i>h f</i> − "
            "<i>γ</i> Δ<i>V</i> + <i>Φ<sub>c</sub></i><sup>⊤</sup> <i>p</i>",
            "<i>q′</i> − <i>q</i> = <i>h v*</i>, &emsp;<i>v*</i> = <i>θ v′</i> + (1 − <i>θ</i>) <i>v</i>",
        ),
    ),
    "signorini": (
        r"0 <= u'_n + b perp p_n >= 0, quad u'_t = 0 #text[ with ] |p_t| <= mu p_n, #text[ or ] p_t = -mu p_n "
        r"op(#text[sign]) u'_t",
        "0 ≤ <i>u′<sub>n</sub></i> + <i>b</i> ⊥ <i>p<sub>n</sub></i> ≥ 0, &emsp;<i>u′<sub>t</sub></i> = 0 with "
        "|<i>p<sub>t</sub></i>| ≤ <i>μ p<sub>n</sub></i>, or <i>p<sub>t</sub></i> = −<i>μ p<sub>n</sub></i> sign "
        "<i>u′<sub>t</sub></i>",
    ),
    "penalty": (
        r"u = (B W B^top + 1 / alpha) F' + b",
        "<i>u</i> = (<i>B W B</i><sup>⊤</sup> + 1/<i>α</i>) <i>F′</i> + <i>b</i>",
    ),
    "flexible energy": (
        r"E(t) - E(0) = W_#text[input] - W_#text[friction] - W_#text[impact] - W_#text[damping] - W_#text[numerical]",
        "<i>E</i>(<i>t</i>) − <i>E</i>(0) = <i>W</i><sub>input</sub> − <i>W</i><sub>friction</sub> − "
        "<i>W</i><sub>impact</sub> − <i>W</i><sub>damping</sub> − <i>W</i><sub>numerical</sub>",
    ),
    "opening zero": (
        r"p(x, g) = p(x) max(0, 1 - g slash w)",
        "<i>p</i>(<i>x</i>, <i>g</i>) = <i>p</i>(<i>x</i>) max(0, 1 − <i>g</i>/<i>w</i>)",
    ),
    "opening full": (
        r"p(x, g) = p(x) + (p_#text[full] - p(x)) min(1, g slash w)",
        "<i>p</i>(<i>x</i>, <i>g</i>) = <i>p</i>(<i>x</i>) + (<i>p</i><sub>full</sub> − <i>p</i>(<i>x</i>)) min(1, "
        "<i>g</i>/<i>w</i>)",
    ),
    "opening follows": (
        r"p(x, g) = p(x) w / (w + g)",
        "<i>p</i>(<i>x</i>, <i>g</i>) = <i>p</i>(<i>x</i>) <i>w</i>/(<i>w</i> + <i>g</i>)",
    ),
    "crack motion": (
        r"a_c (t) = a(t) + sum_k phi_k dot.double(q)_k (t), quad dot.double(q)_k + 2 xi_k omega_k dot(q)_k + "
        r"omega_k^2 q_k "
        r"= -gamma_k a(t)",
        "<i>a<sub>c</sub></i>(<i>t</i>) = <i>a</i>(<i>t</i>) + Σ<sub><i>k</i></sub> <i>φ<sub>k</sub></i> "
        "q̈<sub><i>k</i></sub>(<i>t</i>), &emsp;q̈<sub><i>k</i></sub> + 2 <i>ξ<sub>k</sub> ω<sub>k</sub></i> "
        "q̇<sub><i>k</i></sub> + <i>ω<sub>k</sub></i>² <i>q<sub>k</sub></i> = −<i>γ<sub>k</sub> a</i>(<i>t</i>)",
    ),
    "anchors": (
        r"F = max(0, F_0 + k_a a dot u), quad F_s = -k_s u_t",
        "<i>F</i> = max(0, <i>F</i><sub>0</sub> + <i>k<sub>a</sub> a</i>·<i>u</i>), &emsp;<i>F<sub>s</sub></i> = "
        "−<i>k<sub>s</sub> u<sub>t</sub></i>",
    ),
}

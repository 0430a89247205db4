"""The blanking force of docs/theory/elements.md as functions of Python: its state is (largest penetration, branch)."""

RISE, FRACTURE, SLUG, ELASTIC, APART, THROUGH = range(6)
EVENTS = ["tool_contact", "tool_force_maximum_passed", "fracture_branch_end", "sheet_severed", "tool_unload", "tool_release",
          "tool_reload"]
SMOOTH_END = {RISE: FRACTURE, FRACTURE: SLUG, SLUG: THROUGH}


class Blanking:
    def __init__(self, h, L_s, k_s, eps_m, n, eps_d, rho, c_el, contact_at):
        self.h, self.n, self.rho, self.c_el, self.contact_at = h, n, rho, c_el, contact_at
        self.F_max, self.z_m = k_s * L_s * h, eps_m * h
        self.z_d = self.z_m + eps_d * h

    def virgin(self, branch, z):
        """Force and slope of the virgin curve."""
        if branch == RISE:
            x = 1. - z / self.z_m
            return self.F_max * (1. - x**self.n), self.F_max * self.n * x**(self.n - 1.) / self.z_m
        if branch == FRACTURE:
            d = self.z_d - self.z_m
            x = (z - self.z_m) / d
            return self.F_max * (1. - (1. - self.rho) * x * x * (3. - 2. * x)), -self.F_max * (1. - self.rho) * 6. * x * (1. - x) / d
        if branch == SLUG:
            d = self.h - self.z_d
            x = (z - self.z_d) / d
            return self.rho * self.F_max * (1. - x * x * (3. - 2. * x)), -self.rho * self.F_max * 6. * x * (1. - x) / d
        return 0., 0.

    def branch_at(self, z):
        return APART if z <= 0. else RISE if z < self.z_m else FRACTURE if z < self.z_d else SLUG if z < self.h else THROUGH

    def force_and_slope(self, u, s):
        z_max, branch = s
        z = u - self.contact_at
        if branch == ELASTIC:
            return self.virgin(self.branch_at(z_max), z_max)[0] - self.c_el * (z_max - z), self.c_el
        return self.virgin(branch, z)

    def force(self, t, u, v, s):
        return -self.force_and_slope(u, s)[0]

    def derivative(self, t, u, v, s):
        return -self.force_and_slope(u, s)[1], 0.

    def lift_off(self, z_max):
        return z_max - self.virgin(self.branch_at(z_max), z_max)[0] / self.c_el

    def event_values(self, t, u, v, s):
        z_max, branch = s
        z = u - self.contact_at
        values = [-1.] * len(EVENTS)  # does not occur in this branch
        if branch in SMOOTH_END:
            values[1 + int(branch)] = z - (self.z_m, self.z_d, self.h)[int(branch)]
            values[4] = -v
        elif branch == ELASTIC:
            values[5], values[6] = self.lift_off(z_max) - z, z - z_max
        elif branch == APART:
            values[0] = z - self.lift_off(z_max)
        return values

    def at_event(self, event, t, u, v, s):
        z_max, branch = s
        furthest = self.branch_at(z_max) if z_max > 0. else RISE
        if event in EVENTS[1:5]:
            z_max = max(z_max, u - self.contact_at)
            after = ELASTIC if event == "tool_unload" else SMOOTH_END[int(branch)]
            return (self.h if after == THROUGH else z_max), after
        if event == "tool_release":
            return z_max, APART
        if event == "tool_reload":
            return z_max, furthest
        return z_max, ELASTIC if self.virgin(furthest, z_max)[0] > 0. else furthest

    def after_step(self, t, u, v, s):
        z_max, branch = s
        return s if branch in (ELASTIC, APART) else (max(z_max, min(u - self.contact_at, self.h)), branch)


def with_python_blanking(scene, derivative=True):
    """The press with this law in place of its own."""
    value = {name: scene.copy()[f"parameters.{name}"] for name in ("eps_m", "n_u", "eps_d", "rho_R")}
    law = Blanking(4e-3, 0.8, 320e6, value["eps_m"], value["n_u"], value["eps_d"], value["rho_R"], 9e9, 2 * 80e-3 - 8e-3)
    changed = scene.to_dict()
    del changed["element"]["sheet"]
    changed["output"]["signals"].pop("z")
    return type(scene)(changed).element("sheet", force=law.force, derivative=law.derivative if derivative else None, state=[0., APART],
                                        events=EVENTS, event_values=law.event_values, at_event=law.at_event,
                                        after_step=law.after_step, from_="slide", to="frame.table")

"""The case files that ``heeltoe new`` writes: a short one, and one with every field."""

from __future__ import annotations

import json

_SHORT = """\
# A dam cracked along its base, in El Centro 1940. `heeltoe explain` lists every field;
# `heeltoe new NAME --all` writes a case with all of them.
title = {title}
# rock = "rigid"                   # rigid rock; without a block [rock], rock as stiff as the concrete is assumed

[section]                          # vertical upstream face at x = 0
height = "100 m"
crest_width = "8 m"
neck_height = "90 m"               # where the slope of the downstream face changes
neck_width = "8 m"
base_width = "80 m"

[concrete]
density = "2400 kg/m^3"
modulus = "20 GPa"                 # without it the dam is a rigid block

[crack]
elevation = "0 m"                  # at the upstream face, above the lowest point of the section
friction = 1.0
restitution = 0.5                  # impacts of a rocking block: 0 stays down, 1 loses nothing

[reservoir]
depth = "95 m"                     # above the lowest point of the section

[uplift]
pattern = "triangular"             # or none, uniform, cut-off, drained, profile

[motion]                           # acceleration of the ground, positive downstream
file = "elcentro-1940-180-nga"     # a file beside this one, or a name of `heeltoe motion --list`
pga = "0.4 g"                      # without it the record keeps its peak
# duration = "30 s"                # without it the whole record
"""

_LONG = """\
# A case for heeltoe: one dam, one crack, one earthquake.
#
# Quantities are texts with their unit: "100 m", "328 ft", "2650 kg/m^3", "20 GPa", "0.4 g". Lines that begin
# with # are off; they show what else there is, mostly with its default.

title = {title}
# rock = "rigid"                   # below an elastic dam, in place of [rock]: a plane that carries no wave away
# units = "si"                      # what everything is shown in; "us": feet, inches, kips, psi

# gravity = "9.80665 m/s^2"        # one g, of the weight and of motions given in g
# Anchors or bars across the crack, each with at least one of prestress, axial_stiffness and shear_stiffness:
# anchors = [{{ distance = "5 m", prestress = "2 MN/m", inclination = "0 deg", capacity = "4 MN/m" }}]
# on the crack, from the heel; or by their ends in the section, whatever the crack is: x, and elevation above the base
# anchors = [{{ head_x = "3 m", head_elevation = "99 m", foot_x = "9 m", foot_elevation = "-9 m", \
prestress = "2 MN/m" }}]
# Several cracks, from the crest down, in place of the block [crack] below; each has what that has, and an uplift of its
# own; friction and restitution that one does not state are those of the first:
# cracks = [{{ elevation = "80 m", friction = 1.0, uplift = "triangular" }}, {{ elevation = "0 m", friction = 1.1 }}]
# or further ones beside [crack], in any order:
# further_cracks = [{{ elevation = "80 m", friction = 1.0, uplift = "triangular", uplift_intensity = 0.5 }}]
# Motions after that of [motion], each meeting the dam as the one before has left it; what a motion has, and a pause:
# aftershocks = [{{ file = "elcentro-1940-270-nga", pga = "0.2 g", pause = "10 s" }}]
# A suite of records, which the dam meets one by one, each from rest; its block [suite] is below:
# motions = [{{ file = "elcentro-1940-180-nga" }}, {{ file = "elcentro-1940-270-nga" }}]

# [project]                        # the title block of the report, in your own words
# name = "Safety review"
# client = "Owner of the dam"
# author = "A. B."
# checker = "C. D."
# approver = "E. F."
# date = "2026-01-31"
# revision = "0"
# revisions = [{{ revision = "0", date = "2026-01-31", change = "first issue", author = "A. B.", checker = "C. D.", \
approver = "E. F." }}]

[section]                          # vertical upstream face at x = 0, downstream to the right
height = "100 m"
crest_width = "8 m"
neck_height = "90 m"               # where the slope of the downstream face changes; leave out both
neck_width = "8 m"                 # lines of the neck for a face that is straight from base to crest
base_width = "80 m"
# Or, in place of neck and base, the slopes of both faces below a crest whose upstream edge is at x = 0: each from an
# elevation on, horizontal per vertical:
# upstream = [["0 m", 0.1], ["40 m", 0.0]]
# downstream = [["0 m", 0.8], ["90 m", 0.0]]
# Or the corners in a file, a drawing (DXF) with the section as a closed outline, or a table (CSV) of x and z:
# file = "dam.dxf"
# layer = "SECTION"                # of a drawing with other lines, too
# unit = "m"                       # of a file that does not state it
# Or any other section, by its corners [x, z] in order:
# polygon = [["0 m", "0 m"], ["80 m", "0 m"], ["8 m", "90 m"], ["8 m", "100 m"], ["0 m", "100 m"]]

[concrete]
density = "2400 kg/m^3"
modulus = "20 GPa"                 # without it the dam can only be a rigid block; the next two are of the elastic dam
# poisson = 0.2
# damping = 0.05
# tensile_strength = "1.5 MPa"     # static; the largest tension of the elastic dam is judged by it
# dynamic_tension = 1.5            # that in an earthquake over it (Raphael 1984)

[crack]
elevation = "0 m"                  # at the upstream face, above the lowest point of the section
# inclination = "0 deg"            # positive where the crack rises downstream
# kinks = [["20 m", "0 m"], ["22 m", "1.5 m"]]   # [distance from the heel, height above the line to the toe]
friction = 1.0
# uplift = "none"                  # of one of several cracks, where it differs from [uplift], as does the next
# uplift_intensity = 0.5
# static_friction = 1.1            # instead of friction, where the friction at rest
# kinetic_friction = 1.0           # is higher than in motion
# fit = "fit/law-fit.toml"         # instead of friction and band: what heeltoe law fit has written
restitution = 0.5                  # of a rocking block's impacts: 0 stays down, 1 loses nothing
# rocking_loss = 0.05              # what impacts of a rocking block take beyond theory: 0.03 to 0.05 on concrete
# side_gap = "3 mm"                # joints to either neighbour, closed by shaking across the valley; "free" without

# [crack.roughness]                # asperities that a rigid block climbs; friction is that of their flanks then
# asperity_height = "20 mm"        # the crack dilates by so much at most
# wave_length = "200 mm"           # from peak to peak
# wear = "1e-6 m^2/J"              # c in i = i0 exp(-c W), W the work of friction per area

# [crack.bond]                     # a joint that is not cracked before the earthquake; cores give its numbers
# tensile_strength = "0.8 MPa"     # static; mass concrete itself has 1 to 3 MPa
# cohesion = "1.2 MPa"             # at least friction times tensile_strength
# fracture_energy = "100 N/m"      # to open it; mass concrete takes 100 to 300 N/m
# shear_energy = "1000 N/m"        # to shear it off, beside friction
# initial_energy = "40 N/m"        # of the first of two lines of softening; without it there is one
# dynamic_factor = 1.0             # on both strengths during the earthquake

# [crack.band]                     # what else the friction may be: the dam is run with each
# low = 0.8
# high = 1.2
# slip_weakening = {{ residual_friction = 0.8, slip = "20 mm" }}          # friction falls to so much over this slip,
# speed_weakening = {{ residual_friction = 0.8, speed = "0.1 m/s" }}      # or with the speed of the slip
# judge = "best"                   # or "low", "high", ..., "worst": which of them the limits judge
# Or both ends by a distribution, 5 and 95 % of which lie below them:
# distribution = "lognormal"       # or "normal", "uniform", "triangular"
# median = 1.0                     # of lognormal
# dispersion = 0.15
# mean = 1.0                       # of normal
# std = 0.1
# lower = 0.7                      # cuts normal and lognormal
# upper = 1.3
# from = 0.8                       # of uniform and triangular
# mode = 1.0
# to = 1.2

# A friction law, in place of the coefficients (heeltoe law NAME draws one); each knows some of these fields:
# [crack.law]
# name = "slip weakening"          # or "speed weakening", "cohesion", "barton-bandis", "lift joint"
# form = "linear"                  # of slip weakening; or "exponential"
# peak_friction = 1.2
# residual_friction = 0.8
# slip = "20 mm"                   # over which friction or cohesion is lost
# speed = "0.1 m/s"                # of speed weakening
# cohesion = "0.3 MPa"
# jrc = 10                         # of barton-bandis, as are the next two
# jcs = "20 MPa"
# residual_angle = "32 deg"
# surface = "untreated"            # of a lift joint; or "monolithic", "water-blasted", "plane"
# basic_friction = 0.7
# roughness_friction = [["0.1 MPa", 0.4], ["2 MPa", 0.1]]   # [normal stress, what roughness adds]

[reservoir]                        # leave out for a dry dam
depth = "95 m"                     # above the lowest point of the section
# density = "1000 kg/m^3"
# follows_vertical_motion = false  # pressure on the faces times 1 + a_v / g; needs motion.vertical
# hydrodynamic = "westergaard"     # pressure of water that moves; or "zangar", for a face of one slope
# compressible = false             # before an elastic dam: no sound travels in the water, which is a mass
# wave_speed = "1440 m/s"          # of that sound
# floor_reflection = 0.9           # of a wave of it: 1 rigid floor, less with sediment
# nappe = "none"                   # of water above the crest, on it; or "weight", "falling"
# virtual_mass_rotates = true      # of a rigid block, spread over the face; false: in one point, as in Zhu (2004)

# [tailwater]
# depth = "5 m"

# [rock]                           # below an elastic dam; without it rock with the modulus of the concrete is assumed
# modulus = "30 GPa"               # dynamic, of the rock
# poisson = 0.25
# density = "2650 kg/m^3"
# damping = 0.02                   # of the material at 5 Hz; waves that leave come on top
# radiation = true                 # false: springs far away, and no waves leave
# bears_uplift = true              # water in a crack at the base presses on the rock, too; false: it has settled to it
# massless = false                 # true: no waves at all, as in older practice

# [ice]
# force = "150 kN/m"               # downstream
# depth = "0.3 m"                  # below the water surface

# [silt]
# depth = "10 m"                   # above the lowest point of the section
# horizontal_density = "360 kg/m^3"   # of the fluid that it adds to the water
# vertical_density = "920 kg/m^3"

[uplift]
pattern = "triangular"             # or none, uniform, cut-off, drained, profile
# intensity = 1.0                  # factor on the pressure
# extent = 0.5                     # cut-off: part of the width under pressure
# drain_position = 0.1             # drained: distance from the heel as a part of the width
# drain_x = "6 m"                  # drained, in place of drain_position: vertical drains at this x of the section
# drain_efficiency = 0.667         # drained: 0 no effect on the head there, 1 down to the tailwater's
# points = [[0.0, "95 m"], [1.0, "0 m"]]   # profile: distance as above, head of water
# during_shaking = "constant"      # or "zero while open", "full while open", "follows opening"
# opening = "0.1 mm"               # over which that changes the pressure

# [joints]                         # in place of [crack]: lift joints that are all bonded alike
# every = "10 m"                   # the height of a lift
# lowest = "0 m"
# highest = "90 m"
# bond = {{ tensile_strength = "1 MPa", cohesion = "1 MPa", fracture_energy = "100 N/m", shear_energy = "100 N/m" }}

[motion]                           # the ground's acceleration, positive downstream
file = "elcentro-1940-180-nga"     # a file beside this one, or a name from the catalogue of records
pga = "0.4 g"                      # leave out to take the record as it is
# sign = "recorded"                # or "reversed"; both are run, and the worse one leads, where it is not given
# reverse = true                   # the same as sign = "reversed"
# duration = "30 s"                # leave out for the whole record
# channel = "90 deg"               # of a file with several: by number or by direction
# unit = "cm/s^2"                  # of a file that does not state it
# time_step = "0.02 s"             # of a file with one column that does not state it
# layout = "rows"                  # of a plain table: one series along its rows, or down each of its "columns"
# factor = 1.0                     # of a file with a factor in its header: that one, or 1 where the values contain it
# processing = [{{ step = "band-pass", low = "0.1 Hz", high = "25 Hz" }}, {{ step = "baseline" }}]   # before scaling
# vertical = {{ file = "elcentro-1940-up-nga" }}   # of the same earthquake, positive up; pga, channel etc. as above
# cross_valley = {{ file = "elcentro-1940-270-nga" }}   # across the valley, positive to the left bank
# azimuth = "30 deg"               # of the stream, clockwise from north: both horizontal components are rotated to it
# direction = "180 deg"            # of a component whose record and name do not state theirs
# at = "surface"                   # a motion of the free surface, not deconvolved to a depth within the rock
# allow_zero = true                # accept a motion that is zero throughout
# Or draw the motion, instead of file; the same time twice is a jump:
# points = [["0 s", "0 g"], ["0.5 s", "0.4 g"], ["1 s", "0 g"]]

# [suite]                          # of the records of motions
# pga = "0.3 g"                    # of each; or the spectral acceleration at a period, that of the dam where not given
# sa = "0.5 g"
# period = "0.3 s"
# match = "en1998:0.3g,B"          # match each to this spectrum first
# target = "en1998:0.3g,B"         # draw this spectrum beside theirs
# disaggregation = "Mag_Dist-0.csv#PGA,0.02"   # of OpenQuake: labels records by their share of the hazard
# judge = "mean"                   # what is held against the limits: largest (the default), mean, median, 84%
# both_signs = true                # each record both ways round
# vertical = true                  # with the vertical components of folders
# unit = "g"                       # of files that do not state it
# time_step = "0.01 s"
# layout = "rows"                  # of plain tables whose headers do not say it, or "columns"
# factor = "multiply"              # by the factors in headers, or "divide", or the values "contain" them
# processing = [{{ step = "baseline" }}]   # of every record: a band-pass or a baseline corrects uncorrected ones

# [flexible]
# plane = "stress"                 # or strain
# elements_across = 8              # along the crack
# elements_across_below = 8        # in the part below the crack, where it differs
# elements_away = 8                # far from the crack: so many along a fine crack need not be everywhere
# mesh_above = "above.msh"         # your own mesh of eight-node quadrilaterals in place of ours
# mesh_below = "below.msh"
# modes = 200                      # to keep of each part; all of a small one without it
# damping = "relative"             # or stiffness, modal, thesis, deformation
# damping_on_water = true          # relative: whether its mass term acts on the virtual water too
# virtual_mass = "complete"        # or thesis
# contact = "coulomb"              # exact; or idce, the penalty method of Zhu (2004), for comparison
# contactors = 3                   # which crack nodes are watched, 1 to 5
# time_step = "0.2 ms"             # chosen by the program without it
# evidence = "full"                # "step": another step, but no other mesh and shaking; "none"
# theta = 0.52                     # 0.5 to 1, of coulomb
# penalty_factor = 1000            # of idce, as are the next two
# newmark_gamma = 0.7
# newmark_beta = 0.36

# [analysis]
# silence = "10 s"                 # a run goes on after the motion until the dam is at rest, at most so long
# paradox = "stop"                 # where no motion agrees with Coulomb's law; or "tangential impact"
# event_limit = 1_000_000
# time_limit = "10 min"            # what elastic parts may take, by an estimate before they are run
# memory_limit = "4 GB"
# rotation = "small"               # or "p-delta", "finite": with these a rigid block can overturn

# [decoupled]                      # of --model decoupled: the part below the crack shakes the block above it
# vertical = false                 # with the vertical motion at the crack, too
# rotation = false                 # and with its rotation
# upper_part = "rigid body"        # how the part above is attached below; or "mass on the crack", as in Zhu (2004)

# [limits]                         # what you allow: the verdict and the report compare with it
# residual_slip = "150 mm"
# peak_slip = "200 mm"
# cracked_length = "5 m"          # of a bonded joint
# opening_upstream = "50 mm"
# opening_downstream = "50 mm"
# rotation = "2 mrad"
# crest_displacement = "100 mm"
# crest_acceleration = "2 g"

# [statics]                        # of `heeltoe statics`
# criteria = "USACE"               # or USBR, FERC, CDA, CADAM3D
# criteria_file = "mine.toml"      # in place of criteria: factors of your own
# sections = ["0 m", "30 m"]       # lift joints to judge, the base among them
# structure = "critical"           # or normal
# site_information = "ordinary"    # or "well defined" (by tests), limited
# bonded = 0.5                     # part of the width, from the toe, that is not cracked
# cohesion = "1 MPa"               # of that part, as is the next
# tensile_strength = "1 MPa"
# compressive_strength = "20 MPa"
# flood_depth = "100 m"            # reservoir and tailwater in the flood
# flood_tailwater = "10 m"
# flood_rarity = "unusual"         # or extreme
# seismic_coefficient = 0.1        # of the pseudo-static check, in g
# vertical_seismic_coefficient = 0.05
# Several in place of that one; an OBE is an unusual load, MDE, MCE and SEE are extreme ones; else rarity says it:
# earthquakes = [{{ name = "OBE", seismic_coefficient = 0.1 }}, {{ name = "MDE", seismic_coefficient = 0.2 }}]
# uplift_in_earthquake = "criteria"    # where that opens the crack; or "unchanged", "zero", "full"
# residual_friction = 0.8          # after the earthquake
# residual_slip = "100 mm"         # that of an analysis without it
# drain_diameter = "75 mm"         # drains of a drained uplift that slip closes
# closed_drains = "linear"         # uplift then: "reservoir head" as far as the drains, or "linear" from heel to toe
"""


def new_case_text(name: str, *, every_field: bool = False) -> str:
    """Return a case file in TOML that runs unchanged.

    Parameters
    ----------
    name
        Title of the case; characters that cannot be printed become blanks.
    every_field
        Whether it shows every field, those it does not set as comments.
    """
    printable = "".join(letter if letter.isprintable() else " " for letter in name)
    # A printable text in JSON's quotes is one in TOML's too.
    template = _LONG if every_field else _SHORT
    return template.format(title=json.dumps(printable, ensure_ascii=False))

/* Newmark's sliding block by steps, as one writes it oneself: within a step the mean of the drive acts, and where the
 * slip comes to rest the block waits for the next step. Drive and resistances are per mass [m/s2]; `down` resists slip
 * downstream, `up` upstream. */

static double slide(const double *drive, long samples, double dt, double scale, double down, double up, double *slip)
{
    double speed = 0.0, place = 0.0;
    for (long k = 0; k + 1 < samples; k++) {
        double pull = 0.5 * scale * (drive[k] + drive[k + 1]);
        if (speed != 0.0 || pull > down || pull < -up) {
            double friction = speed > 0.0 || (speed == 0.0 && pull > 0.0) ? down : -up;
            double rate = pull - friction, next = speed + rate * dt, time = dt;
            if (speed * next < 0.0) {
                time = -speed / rate;
                next = 0.0;
            }
            place += time * (speed + 0.5 * rate * time);
            speed = next;
        }
        if (slip)
            slip[k + 1] = place;
    }
    return place;
}

/* One block, with its slip at every sample. */
void newmark(const double *drive, long samples, double dt, double down, double up, double *slip)
{
    slip[0] = 0.0;
    slide(drive, samples, dt, 1.0, down, up, slip);
}

/* Many blocks, each with its resistances and its factor on the drive; their slips at the end. */
void newmark_many(const double *drive, long samples, double dt, long blocks, const double *scale, const double *down,
                  const double *up, double *slip)
{
    for (long k = 0; k < blocks; k++)
        slip[k] = slide(drive, samples, dt, scale[k], down[k], up[k], 0);
}

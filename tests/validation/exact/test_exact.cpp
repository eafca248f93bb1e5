// The references themselves: invariants, limits, and figures found independently (two integrations of the drop's
// equations in another language, a Crank-Nicolson solution, a root finder on the same determinant).
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/validation/exact/drop.h"
#include "tests/validation/exact/flows.h"
#include "tests/validation/exact/waves.h"

using namespace headrace;

TEST_CASE("EllipticalDrop.KeepsItsInvariants") {
    exact::EllipticalDrop drop(-100.0, 0.0, 1.0);
    const double start = drop.energy(0.0, 1000.0);
    CHECK(start == Approx(7853981.63397).epsilon(1e-11));
    for (double t = 0.0; t <= 0.01; t += 1e-3) {
        const exact::Ellipse e = drop.at(t);
        CHECK(e.a * e.b == Approx(1.0).epsilon(1e-10));  // fourth order at 0.002: 1e-11 a unit of time
        CHECK(e.s == Approx(-100.0 * std::sqrt(2 / (e.a * e.a + e.b * e.b))).epsilon(1e-10));
        CHECK(drop.energy(t, 1000.0) == Approx(start).epsilon(1e-10));
    }
}

TEST_CASE("EllipticalDrop.GivesThePublishedSemiAxis") {
    exact::EllipticalDrop drop(-100.0, 0.0, 1.0);
    CHECK(drop.at(0.0082).b == Approx(2.02676233).epsilon(1e-8));     // last printed digit
    CHECK(drop.at(0.0076).b == Approx(1.9445171907).epsilon(1e-10));  // going back starts anew
    CHECK(exact::drop_centre_pressure(drop.at(0.0), 0.0, 1000.0) == Approx(5e6));
}

TEST_CASE("EllipticalDrop.OscillatesWithTheKnownPeriods") {
    const double periods[3][2]{{0.5, 4.567373801}, {1.0, 4.827343008}, {2.0, 5.281273864}};
    for (const auto& [s0, period] : periods)
        CHECK(exact::EllipticalDrop(s0, 1.0, 1.0).period() == Approx(period).epsilon(1e-9));
    CHECK(exact::EllipticalDrop(-1.0, 1.0, 1.0).period() == Approx(4.827343008).epsilon(1e-9));
    exact::EllipticalDrop drop(1.0, 1.0, 1.0);
    CHECK(drop.at(4.827343008 / 4).a == Approx(1.9318517).epsilon(1e-7));
}

TEST_CASE("TaylorGreen.SolvesNavierStokes") {
    const double nu = 0.01, d = 1e-3, x = 0.13, y = 0.37, t = 0.4;
    const auto at = [&](double dx, double dy, double dt) {
        return exact::taylor_green(x + dx, y + dy, t + dt, 1.0, 1.0, nu, 1.0);
    };
    const auto u = at(0, 0, 0), e = at(d, 0, 0), w = at(-d, 0, 0), n = at(0, d, 0), s = at(0, -d, 0);
    const double inertia = (at(0, 0, d).u - at(0, 0, -d).u + u.u * (e.u - w.u) + u.v * (n.u - s.u)) / (2 * d);
    const double viscous = nu * (e.u + w.u + n.u + s.u - 4 * u.u) / (d * d);
    // Second differences: (2 pi)^3 d^2 / 6 = 4e-5 of each term.
    CHECK(inertia + (e.p - w.p) / (2 * d) - viscous == Approx(0.0).margin(3e-4));
    CHECK(e.u - w.u + n.v - s.v == Approx(0.0).margin(1e-12));
}

TEST_CASE("ChannelFlow.StartsAtRestAndEndsSteady") {
    const double L = 1e-3, nu = 1e-6, V0 = 1.25e-5, F = 1e-4;
    CHECK(exact::couette(L / 4, 100.0, V0, L, nu) == Approx(V0 / 4));
    CHECK(exact::poiseuille(L / 2, 100.0, F, L, nu) == Approx(F * L * L / (8 * nu)));
    CHECK(exact::couette(L / 2, 1e-3, V0, L, nu) == Approx(0.0).margin(1e-12 * V0));
    CHECK(exact::poiseuille(L / 2, 1e-3, F, L, nu) == Approx(F * 1e-3));  // the walls are not felt yet
    // From a table computed by other means.
    CHECK(exact::couette(2e-5, 0.045, V0, L, nu) == Approx(5.17948467e-09).epsilon(1e-8));
    CHECK(exact::poiseuille(2e-5, 0.1125, F, L, nu) == Approx(7.131294173e-07).epsilon(1e-9));
}

TEST_CASE("StillColumn.CarriesItsWeight") {
    for (const bool tait : {false, true}) {
        const exact::StillColumn column{1000.0, 30.0, 9.81, tait};
        double load = 0.0;  // [kg/m^2] midpoint sum over 1 m
        const int slices = 1000;
        for (int k = 0; k < slices; ++k) load += column.density((k + 0.5) / slices) / slices;
        CHECK(column.pressure(1.0) == Approx(9.81 * load).epsilon(1e-8));
        CHECK(column.depth_of(load) == Approx(1.0).epsilon(1e-8));
        CHECK(column.pressure(0.0) == 0.0);
    }
}

TEST_CASE("ViscousWave.HasTheKnownEigenvalues") {
    struct Row {
        double lambda, H, nu, rate, omega, no_slip_rate, no_slip_omega;
    };
    const Row rows[]{{1, 0.5, 1e-3, 0.07499889, 7.83240459, 0.07662622013, 7.830949893},
                     {1, 1, 1e-3, 0.07498782697, 7.847013777, 0.07499086842, 7.847011058},
                     {1, 0.5, 1e-4, 0.007770805718, 7.836217822, 0.008250417285, 7.835753688},
                     {1, 0.25, 1e-3, 0.075237, 7.515041, 0.112294, 7.482031}};
    for (const Row& row : rows) {
        const double k = 2 * std::numbers::pi / row.lambda;
        const auto slip = exact::viscous_wave_eigenvalue(k, row.H, 9.81, row.nu, false);
        const auto no_slip = exact::viscous_wave_eigenvalue(k, row.H, 9.81, row.nu, true);
        CHECK(-slip.real() == Approx(row.rate).epsilon(1e-5));  // the last row has 6 decimals
        CHECK(slip.imag() == Approx(row.omega).epsilon(1e-6));
        CHECK(-no_slip.real() == Approx(row.no_slip_rate).epsilon(1e-5));
        CHECK(no_slip.imag() == Approx(row.no_slip_omega).epsilon(1e-6));
    }
}

TEST_CASE("LatticeSound.HasTheKnownPhaseSpeeds") {
    using exact::SoundKernel;
    CHECK(exact::lattice_sound_speed(SoundKernel::wendland_c2, 2, 1.3, 32) == Approx(0.96503).epsilon(1e-5));
    CHECK(exact::lattice_sound_speed(SoundKernel::wendland_c2, 2, 2.0, 128) == Approx(0.99785).epsilon(1e-5));
    CHECK(exact::lattice_sound_speed(SoundKernel::wendland_c2, 3, 1.3, 24) == Approx(0.96411).epsilon(1e-5));
    CHECK(exact::lattice_sound_speed(SoundKernel::cubic_spline, 2, 1.0, 16) == Approx(0.98726072).epsilon(1e-7));
}

TEST_CASE("CapillaryDrop.FrequencyIsLambs") {
    CHECK(exact::drop_frequency_2d(2, 1.0, 1.0, 1.0) == Approx(std::sqrt(6.0)));
    CHECK(exact::drop_decay_2d(2, 1.0, 1.0) == Approx(4.0));
}

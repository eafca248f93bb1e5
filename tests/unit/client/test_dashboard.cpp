#include <catch2/catch.hpp>
#include <limits>

#include "client/dashboard.h"
#include "client/terminal.h"

using namespace headrace;
using client::Dashboard;
using client::Glyphs;

namespace {

proto::SimStatusReply running() {
    proto::SimStatusReply status;
    status.state = proto::SimState::running;
    status.scene = "tank";
    status.model = "wcsph";
    status.dimensions = 2;
    status.step = 1'234;
    status.time = 0.5;
    status.time_step = 0.001;
    status.time_step_limit = "acoustic";
    status.particles = 2'500;
    status.steps_per_second = 100;
    status.diagnostics = proto::Diagnostics{1.5, 2.0, 3.0, 990.0, 1'100.0};
    return status;
}

std::string text_of(const Dashboard& dashboard, int rows = 100, int columns = 100) {
    std::string text;
    for (const std::string& line : dashboard.lines(rows, columns, true)) text += line + "\n";
    return text;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("Dashboard.TellsClockRatesEnergyAndDensityError") {
    Dashboard dashboard("ipc://x", {});
    dashboard.add(running(), {1'000.0, -0.25});
    const std::string text = text_of(dashboard);
    for (const char* part : {"tank (wcsph)  running  ipc://x", "1,234", "0.5 s", "0.001 s, limit: acoustic", "2,500",
                             "1.5 m/s", "2 J/m", "5 J/m", "-0.25 J/m", "mean -1 %", "largest 10 %", "q quit"})
        CHECK(has(text, part));
}

TEST_CASE("Dashboard.LeavesOutWhatIsNotKnown") {
    Dashboard dashboard("ipc://x", {});
    dashboard.add(running(), {});
    CHECK_FALSE(has(text_of(dashboard), "density error"));
    CHECK_FALSE(has(text_of(dashboard), "energy error"));
    proto::SimStatusReply empty;
    Dashboard idle("ipc://x", {});
    idle.add(empty, {});
    CHECK(has(text_of(idle), "no scene  empty"));
    CHECK_FALSE(has(text_of(idle), "steps/s"));
}

// A model that could follow its energies has a stage for that in its plan, which is skipped while no probe asks for it.
TEST_CASE("Dashboard.SaysHowTheEnergyErrorIsToBeHad") {
    Dashboard dashboard("ipc://x", {});
    proto::SimStatusReply status = running();
    status.dimensions = 3;
    status.plan = {{"continuity", true, "", 0.0}, {"energies", false, "no probe follows them", 0.0}};
    dashboard.add(status, {});
    CHECK(has(text_of(dashboard), "2 J   "));
    CHECK(
        has(text_of(dashboard), "energy error    not followed, as that makes steps longer: e adds a probe that does"));
    std::string snapshot;
    for (const std::string& line : dashboard.lines(100, 100, false)) snapshot += line + "\n";
    CHECK(has(snapshot, "energy error    not followed: a probe of the kind energies does (headrace help probes)"));
    status.plan[1].active = true;
    dashboard.add(status, {1'000.0, 0.5});
    CHECK(has(text_of(dashboard), "0.5 J "));
    CHECK_FALSE(has(text_of(dashboard), "not followed"));
}

TEST_CASE("Dashboard.WarnsOfFaultsStallsAndBadEventsOnly") {
    Dashboard dashboard("ipc://x", {});
    proto::SimStatusReply status = running();
    status.stalled = true;
    status.fault = proto::FaultReport{"left_domain", 7, {}, {}, 3, 0.1, "use a smaller time step"};
    dashboard.add(status, {});
    proto::Event harmless, bad;
    harmless.type = "object.removed";
    harmless.message = "panel";
    bad.type = "probe.failed";
    bad.message = "probe gauge cannot be evaluated";
    dashboard.add(harmless);
    dashboard.add(bad);
    const std::string text = text_of(dashboard);
    CHECK(has(text, "faulted: left_domain, particle 7; use a smaller time step"));
    CHECK(has(text, "the run waits for a reader"));
    CHECK(has(text, "probe gauge cannot be evaluated"));
    CHECK_FALSE(has(text, "panel"));
}

TEST_CASE("Dashboard.TellsHowFarEachReaderIsBehind") {
    Dashboard dashboard("ipc://x", {});
    proto::SimStatusReply status = running();
    status.readers = {{"data/1", proto::StreamMode::lossless, true, 131, 16, 16},
                      {"frame/1", proto::StreamMode::live, false, 0, {}, {}}};
    dashboard.add(status, {});
    CHECK(has(text_of(dashboard), "131 frames, 16 of 16 behind, full"));
    CHECK(has(text_of(dashboard), "0 frames, nobody listens"));
}

TEST_CASE("Dashboard.FitsTheScreenAndKeepsTheKeys") {
    Dashboard dashboard("ipc://x", {});
    dashboard.add(running(), {1'000.0, 0.0});
    for (const int rows : {3, 5, 8, 14}) {
        const auto lines = dashboard.lines(rows, 40, true);
        CHECK(lines.size() <= static_cast<std::size_t>(rows));
        CHECK(has(lines.back(), "q quit"));
    }
    CHECK_FALSE(dashboard.lines(1, 10, true).empty());
}

TEST_CASE("Dashboard.ANewRunBeginsNewCurves") {
    Dashboard dashboard("ipc://x", {Glyphs::ascii, false});
    proto::SimStatusReply status = running();
    for (const double speed : {10.0, 20.0, 30.0}) {
        status.steps_per_second = speed;
        dashboard.add(status, {});
    }
    CHECK(has(text_of(dashboard), "_~#\n"));
    status.step = 0;
    dashboard.add(status, {});
    CHECK_FALSE(has(text_of(dashboard), "_~#"));
}

TEST_CASE("Sparkline.SpansFromTheLeastToTheLargest") {
    CHECK(client::sparkline({0, 1, 2, 3, 4, 5, 6, 7}, 8, Glyphs::unicode) == "▁▂▃▄▅▆▇█");
    CHECK(client::sparkline({0, 1, 2, 3, 4, 5, 6, 7}, 2, Glyphs::unicode) == "▁█");
    CHECK(client::sparkline({5, 5, 5}, 8, Glyphs::ascii) == "___");
    CHECK(client::sparkline({}, 8, Glyphs::ascii).empty());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(client::sparkline({1, nan, 2}, 8, Glyphs::ascii) == "_!#");
}

TEST_CASE("Terminal.TextIsCutByLettersNotBytes") {
    CHECK(client::cut_to_width("abc", 2) == "ab");
    CHECK(client::cut_to_width("▁▂▃", 2) == "▁▂");
    CHECK(client::cut_to_width("\x1b[1mab\x1b[0mc", 2) == "\x1b[1mab\x1b[0m");
    CHECK(client::cut_to_width("a", 5) == "a");
    CHECK(client::cut_to_width("abc", 0).empty());
}

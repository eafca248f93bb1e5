// Recordings: where they may go, and that they are whole.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "proto/recording.h"
#include "tests/support/server/client.h"
#include "tests/support/server/scenes.h"
#include "tests/support/server/test_server.h"

using namespace headrace;
using namespace headrace::test;
namespace fs = std::filesystem;

namespace {

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("Records.ARecordingHoldsEveryFrameAndTheCommands") {
    TestServer server;
    Client client(server->control_endpoint());
    client.call("scene.load", {{"scene", pond()}});
    const Json started = client.call("record.start", {{"file", "run.mcap"}, {"every_steps", 5}});
    CHECK(client.call("sim.status")["recordings"] == 1);
    client.call("sim.step", {{"steps", 40}});
    client.call("objects.remove", {{"name", "tank"}});
    const Json stopped = client.call("record.stop", {{"recording", started["recording"]}});
    // The first state and every fifth step.
    CHECK(stopped["frames"] == 9);
    CHECK(stopped["gaps"] == 0);
    CHECK(client.call("sim.status")["recordings"] == 0);

    const fs::path file = server.data_folder() / "run.mcap";
    CHECK(stopped["bytes"] == fs::file_size(file));
    const auto reader = proto::RecordingReader::open(file);
    REQUIRE(reader.ok());
    CHECK((*reader)->summary().complete);
    REQUIRE((*reader)->frame_count() == 9);
    CHECK((*reader)->frame_time(8) == Approx(0.04));
    const auto frame = (*reader)->read_frame(8);
    REQUIRE(frame.ok());
    CHECK(frame->info.step == 40);
    CHECK(frame->info.particle_count == 100);

    const std::string bytes = bytes_of(file);
    CHECK(bytes.find(R"("method":"objects.remove")") != std::string::npos);
    CHECK(bytes.find("object.removed") != std::string::npos);
}

TEST_CASE("Records.NothingIsWrittenOutsideTheDataFolder") {
    TestServer server;
    Client client(server->control_endpoint());
    client.call("scene.load", {{"scene", pond()}});
    fs::create_directory(server.folder() / "outside");
    fs::create_directory_symlink(server.folder() / "outside", server.data_folder() / "link");
    fs::create_symlink(server.folder() / "outside" / "target.mcap", server.data_folder() / "file.mcap");
    const std::string absolute = (server.folder() / "outside" / "x.mcap").string();
    for (const std::string& file :
         {std::string("../x.mcap"), std::string("a/../../x.mcap"), absolute, std::string("link/x.mcap"),
          std::string("file.mcap"), std::string("x.txt"), std::string(""), std::string(".mcap/../../x.mcap"),
          std::string("no/x.mcap"), std::string("link/../../x.mcap")}) {
        for (const bool overwrite : {false, true}) {
            INFO(file << ", overwrite " << overwrite);
            const Answer answer = client.ask("record.start", {{"file", file}, {"overwrite", overwrite}});
            CHECK((answer.error_name() == "file_error" || answer.error_name() == "invalid_params"));
        }
    }
    CHECK(client.ask("record.start", {{"file", "../x.mcap"}}).path() == "params.file");
    CHECK(fs::is_empty(server.folder() / "outside"));
    CHECK_FALSE(fs::exists(server.folder() / "x.mcap"));
    CHECK(client.call("sim.status")["recordings"] == 0);
}

TEST_CASE("Records.AnExistingFileIsReplacedOnlyOnRequest") {
    TestServer server;
    Client client(server->control_endpoint());
    client.call("scene.load", {{"scene", pond()}});
    std::ofstream(server.data_folder() / "old.mcap") << "precious";
    CHECK(client.ask("record.start", {{"file", "old.mcap"}}).error_name() == "file_error");
    CHECK(bytes_of(server.data_folder() / "old.mcap") == "precious");
    client.call("record.start", {{"file", "old.mcap"}, {"overwrite", true}});
    client.call("record.stop");
    CHECK(proto::RecordingReader::open(server.data_folder() / "old.mcap").ok());
}

TEST_CASE("Records.StoppingAsksForOneThatRuns") {
    TestServer server;
    Client client(server->control_endpoint());
    client.call("scene.load", {{"scene", pond()}});
    CHECK(client.ask("record.stop").error_name() == "recording_not_found");
    client.call("record.start", {{"file", "a.mcap"}});
    client.call("record.start", {{"file", "b.mcap"}});
    const Answer which = client.ask("record.stop");
    CHECK(which.error_name() == "invalid_params");
    CHECK(which.hint().find("rec/1") != std::string::npos);
    CHECK(client.ask("record.stop", {{"recording", "rec/9"}}).error_name() == "recording_not_found");
    CHECK(client.call("record.stop", {{"recording", "rec/1"}})["file"] == "a.mcap");
    CHECK(client.call("record.stop")["file"] == "b.mcap");
}

TEST_CASE("Records.AServerThatEndsCompletesItsRecordings") {
    const TempFolder folder;
    server::ServerOptions options;
    options.bind = "ipc://" + (folder.path() / "s").string();
    options.data_folder = folder.path();
    options.threads = 1;
    {
        server::Server server(options);
        server.start();
        Client client(server.control_endpoint());
        client.call("scene.load", {{"scene", pond()}});
        client.call("record.start", {{"file", "end.mcap"}, {"every_steps", 1}});
        client.call("sim.step", {{"steps", 10}});
        client.call("server.shutdown");
    }
    const auto reader = proto::RecordingReader::open(folder.path() / "end.mcap");
    REQUIRE(reader.ok());
    CHECK((*reader)->summary().complete);
    CHECK((*reader)->frame_count() == 11);
}

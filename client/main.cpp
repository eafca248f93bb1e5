// headrace: the client.
#include <csignal>

#include "client/cli.h"

int main(int argc, char** argv) {
    // A limit of file sizes is a failed write then, which is told and leaves nothing half written.
    std::signal(SIGXFSZ, SIG_IGN);
    return headrace::client::run_command_line(argc, argv);
}

// headrace: the client.
#include <csignal>

#include "client/cli.h"

int main(int argc, char** argv) {
    std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is a failed write, which is told and leaves nothing half written
    return headrace::client::run_command_line(argc, argv);
}

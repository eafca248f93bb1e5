// headrace: the client.
#include "client/cli.h"

int main(int argc, char** argv) {
    return headrace::client::run_command_line(argc, argv);
}

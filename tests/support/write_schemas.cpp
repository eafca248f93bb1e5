// Writes the generated files of proto/schemas into a folder: run it after a change of a message.
//     headrace_schemas [FOLDER]
#include <fstream>
#include <iostream>

#include "tests/support/schema_files.h"

int main(int argc, char** argv) {
    const std::filesystem::path folder = argc > 1 ? argv[1] : headrace::test::schema_folder();
    for (const auto& [name, text] : headrace::test::schema_files()) {
        std::ofstream file(folder / name, std::ios::binary);
        if (!(file << text).flush()) {
            std::cerr << "cannot write " << (folder / name) << "\n";
            return 1;
        }
    }
    return 0;
}

// The makers behind make_writer, one per format.
#pragma once

#include <memory>

#include "client/writers/writer.h"

namespace headrace::client {

std::unique_ptr<Writer> make_vtp_writer(const WriterOptions& options);
std::unique_ptr<Writer> make_csv_writer(const WriterOptions& options);
std::unique_ptr<Writer> make_long_csv_writer(const WriterOptions& options);
std::unique_ptr<Writer> make_npz_writer(const WriterOptions& options);
std::unique_ptr<Writer> make_ply_writer(const WriterOptions& options);
std::unique_ptr<Writer> make_picture_writer(const WriterOptions& options);
bool has_ffmpeg();  // on the PATH: films need it
std::unique_ptr<Writer> make_mp4_writer(const WriterOptions& options);
std::unique_ptr<Writer> make_pov_writer(const WriterOptions& options);

}  // namespace headrace::client

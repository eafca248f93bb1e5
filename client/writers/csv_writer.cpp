// Comma-separated values: one file per frame, one row per particle, numbers that read back exactly; ParaView and pandas
// take them as they are. <stem>_frames.csv tells the time of each file.
#include <string>

#include "client/writers/exact_text.h"
#include "client/writers/file_output.h"
#include "client/writers/formats.h"

namespace headrace::client {

namespace {

// "id,position_x [m],position_y [m],density [kg/m^3]"
std::string header_row(const proto::FrameView& frame) {
    std::string row;
    for (const proto::FrameColumn& column : frame.columns) {
        const proto::FieldInfo& info = proto::field_info(column.field);
        for (int component = 0; component < column.components; ++component) {
            if (!row.empty()) row += ',';
            row += info.name;
            if (info.is_vector) row += std::string("_") + "xyz"[component];
            if (info.unit != "1") row += " [" + std::string(info.unit) + "]";
        }
    }
    return row + '\n';
}

class CsvWriter final : public Writer {
  public:
    explicit CsvWriter(const WriterOptions& options) : options_(options) {}

    proto::Result<InOrder> prepare(const FrameTask& task) override {
        const proto::FrameView& frame = task.frame;
        std::string text = header_row(frame);
        for (std::size_t row = 0; row < frame.info.particle_count; ++row) {
            char separator = 0;
            for (const proto::FrameColumn& column : frame.columns)
                for (int component = 0; component < column.components; ++component) {
                    if (separator != 0) text += separator;
                    separator = ',';
                    append_value(text, column, row, component);
                }
            text += '\n';
        }

        const std::string name = numbered_name(options_.stem, task.number, frame_extension());
        if (auto written = write_file(options_.folder / name, {as_bytes(text)}); !written) return written.error();
        return InOrder([this, info = frame.info, name] {
            append_number(index_, info.step);
            index_ += ',';
            append_number(index_, info.time);
            index_ += ',';
            append_number(index_, info.particle_count);
            index_ += ',' + name + '\n';
            ++frames_;
            return proto::Status(proto::Done{});
        });
    }

    proto::Status finish() override { return write_file(index_path(), {as_bytes(index_)}); }

    std::string summary() const override {
        return std::to_string(frames_) + " files " + (options_.folder / (options_.stem + "_*.csv")).string() +
               ", their times in " + index_path().string();
    }

    std::string_view frame_extension() const override { return "csv"; }

  private:
    std::filesystem::path index_path() const { return options_.folder / (options_.stem + "_frames.csv"); }

    WriterOptions options_;
    std::string index_{"step,time [s],particles,file\n"};
    std::size_t frames_{0};
};

}  // namespace

std::unique_ptr<Writer> make_csv_writer(const WriterOptions& options) {
    return std::make_unique<CsvWriter>(options);
}

}  // namespace headrace::client

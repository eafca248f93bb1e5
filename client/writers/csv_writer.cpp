// Comma-separated values: one file per frame, one row per particle, numbers that read back exactly; ParaView and pandas
// take them as they are. <stem>_frames.csv tells the time of each file.
#include <charconv>
#include <cmath>
#include <string>

#include "client/writers/file_output.h"
#include "client/writers/formats.h"

namespace headrace::client {

namespace {

template <class Number>
void append_number(std::string& text, Number number) {
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, number);
    text.append(digits, end.ptr);
}

// The shortest digits that give back the stored bits: a "<f4" value is printed as float.
void append_value(std::string& text, const proto::FrameColumn& column, std::size_t row, int component) {
    const double value = proto::FrameView::value(column, row, component);
    if (column.dtype == "<f4")
        append_number(text, static_cast<float>(value));
    else if (column.dtype == "<u4")
        append_number(text, static_cast<std::uint64_t>(value));
    else
        append_number(text, value);
}

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

    proto::Status write(const proto::FrameView& frame, const std::vector<proto::ObjectDesc>&) override {
        text_ = header_row(frame);
        for (std::size_t row = 0; row < frame.info.particle_count; ++row) {
            char separator = 0;
            for (const proto::FrameColumn& column : frame.columns)
                for (int component = 0; component < column.components; ++component) {
                    if (separator != 0) text_ += separator;
                    separator = ',';
                    append_value(text_, column, row, component);
                }
            text_ += '\n';
        }

        const std::string name = numbered_name(options_.stem, frames_, "csv");
        const proto::Status written = write_file(options_.folder / name, {as_bytes(text_)});
        if (!written) return written;

        append_number(index_, frame.info.step);
        index_ += ',';
        append_number(index_, frame.info.time);
        index_ += ',';
        append_number(index_, frame.info.particle_count);
        index_ += ',' + name + '\n';
        ++frames_;
        return proto::Done{};
    }

    proto::Status finish() override { return write_file(index_path(), {as_bytes(index_)}); }

    std::string summary() const override {
        return std::to_string(frames_) + " files " + (options_.folder / (options_.stem + "_*.csv")).string() +
               ", their times in " + index_path().string();
    }

  private:
    std::filesystem::path index_path() const { return options_.folder / (options_.stem + "_frames.csv"); }

    WriterOptions options_;
    std::string text_;  // of the frame at hand, kept for its capacity
    std::string index_{"step,time [s],particles,file\n"};
    std::size_t frames_{0};
};

}  // namespace

std::unique_ptr<Writer> make_csv_writer(const WriterOptions& options) {
    return std::make_unique<CsvWriter>(options);
}

}  // namespace headrace::client

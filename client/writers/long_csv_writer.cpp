// The whole recording as one table in long form, one value a row: time,step,id,field,component,value. What R, pandas
// and databases group by; `component` is empty for scalars. Large: about 40 bytes a value.
#include "client/writers/exact_text.h"
#include "client/writers/file_output.h"
#include "client/writers/formats.h"

namespace headrace::client {

namespace {

class LongCsvWriter final : public Writer {
  public:
    explicit LongCsvWriter(const WriterOptions& options) : file_(options.folder / (options.stem + "_long.csv")) {}

    proto::Result<InOrder> prepare(const FrameTask& task) override {
        const proto::FrameView& frame = task.frame;
        const proto::FrameColumn* id = frame.find(proto::Field::id);
        if (id == nullptr)
            return proto::Error{proto::ErrorCode::invalid_params, "the frames hold no field `id`", "fields",
                                "record with it, or choose the format csv"};
        std::string moment;
        append_number(moment, frame.info.time);
        moment += ',';
        append_number(moment, frame.info.step);
        moment += ',';

        std::string text;
        for (std::size_t row = 0; row < frame.info.particle_count; ++row)
            for (const proto::FrameColumn& column : frame.columns) {
                if (&column == id) continue;
                const proto::FieldInfo& info = proto::field_info(column.field);
                for (int component = 0; component < column.components; ++component) {
                    text += moment;
                    append_value(text, *id, row, 0);
                    text.append(",").append(info.name).append(",");
                    if (info.is_vector) text += "xyz"[component];
                    text += ',';
                    append_value(text, column, row, component);
                    text += '\n';
                }
            }
        return InOrder([this, text = std::move(text)] {
            ++frames_;
            return append(text);
        });
    }

    proto::Status finish() override {
        if (auto done = append({}); !done) return done;
        return file_.commit();
    }

    std::string summary() const override {
        return std::to_string(frames_) + " frames as one long table: " + file_.path().string();
    }

  private:
    proto::Status append(std::string_view text) {
        if (!has_header_)
            if (auto done = file_.append("time,step,id,field,component,value\n"); !done) return done;
        has_header_ = true;
        return file_.append(text);
    }

    GrowingFile file_;
    bool has_header_{false};
    std::size_t frames_{0};
};

}  // namespace

std::unique_ptr<Writer> make_long_csv_writer(const WriterOptions& options) {
    return std::make_unique<LongCsvWriter>(options);
}

}  // namespace headrace::client

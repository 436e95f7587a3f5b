#include "measure/bytes/row_bytes.h"

#include <algorithm>

namespace gnomon::measure {

namespace {

using hierarchy::ByteReader;
using hierarchy::ByteWriter;

struct PutValue {
    ByteWriter& out;

    void operator()(std::monostate /*nothing*/) const {}

    void operator()(bool value) const { out.put(static_cast<std::uint8_t>(value)); }

    void operator()(std::int64_t value) const { out.put(value); }

    void operator()(double value) const { out.put(value); }

    void operator()(const std::string& value) const { out.putText(value); }
};

telemetry::Value takeValue(ByteReader& in) {
    switch (in.take<std::uint8_t>()) {
    case 0:
        return {};
    case 1:
        return in.take<std::uint8_t>() != 0;
    case 2:
        return in.take<std::int64_t>();
    case 3:
        return in.take<double>();
    case 4:
        return in.takeText();
    default:
        throw hierarchy::Damage{"a value of no type"};
    }
}

} // namespace

void putRows(ByteWriter& out, const std::vector<telemetry::FrameRow>& rows) {
    out.putVarint(rows.size());
    for (const telemetry::FrameRow& row : rows)
        for (const telemetry::Column& column : telemetry::columns()) {
            const telemetry::Value value = column.value(row);
            out.put(static_cast<std::uint8_t>(value.index()));
            std::visit(PutValue{out}, value);
        }
}

std::vector<telemetry::FrameRow> takeRows(ByteReader& in) {
    std::vector<telemetry::FrameRow> rows;
    std::vector<telemetry::Value> values(telemetry::columns().size());
    for (std::uint64_t left = in.takeVarint(); left > 0; --left) {
        std::generate(values.begin(), values.end(), [&] { return takeValue(in); });
        rows.push_back(telemetry::rowOf(values));
    }
    return rows;
}

} // namespace gnomon::measure

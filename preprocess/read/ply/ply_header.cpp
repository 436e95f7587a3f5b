#include "preprocess/read/ply/ply_header.h"

#include "core/error.h"
#include "preprocess/read/text/text_stream.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

namespace gnomon::read {

namespace {

// The max size of a PLY header in bytes, which is much larger than any real header. Without this limit, a file without
// end_header would be read completely.
constexpr std::uint64_t kLargestHeader = 1U << 20U;

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypeNames = {{
    {"char", PlyType::Int8},
    {"int8", PlyType::Int8},
    {"uchar", PlyType::Uint8},
    {"uint8", PlyType::Uint8},
    {"short", PlyType::Int16},
    {"int16", PlyType::Int16},
    {"ushort", PlyType::Uint16},
    {"uint16", PlyType::Uint16},
    {"int", PlyType::Int32},
    {"int32", PlyType::Int32},
    {"uint", PlyType::Uint32},
    {"uint32", PlyType::Uint32},
    {"float", PlyType::Float32},
    {"float32", PlyType::Float32},
    {"double", PlyType::Float64},
    {"float64", PlyType::Float64},
}};

class HeaderParser {
public:
    /// Prepares to parse the header in `text`. The header begins after a UTF-8 byte order mark of `markBytes` bytes.
    HeaderParser(const InputFile& file, std::string_view text, std::size_t markBytes)
        : file_(file), text_(text), position_(markBytes) {}

    PlyHeader parse() {
        findLineEnd();
        while (true) {
            const std::vector<std::string_view> line = wordsOf(nextLine());
            if (!line.empty() && line[0] == "end_header") break;
            if (!line.empty()) statement(line);
        }
        if (!format_) fail("the header has no format line");
        header_.format = *format_;
        header_.bodyOffset = position_;
        header_.bodyLine = line_ + 1;
        return std::move(header_);
    }

private:
    [[noreturn]] void fail(const std::string& what) const { throw Error(atLine(file_.path(), line_), what); }

    // Finds out how lines end, from the first line only. In a binary file, the first byte after the header can look
    // like a line end.
    void findLineEnd() {
        if (!text_.substr(position_).starts_with("ply"))
            throw Error(atByte(file_.path(), 0), "not a PLY file: the first line is not \"ply\"");
        const std::size_t end = text_.find_first_of("\r\n");
        const bool isOldMac = end != std::string_view::npos && text_[end] == '\r' && text_.substr(end + 1, 1) != "\n";
        header_.lineEnd = isOldMac ? '\r' : '\n';
        const std::vector<std::string_view> magic = wordsOf(nextLine());
        if (magic.size() != 1 || magic[0] != "ply")
            throw Error(atByte(file_.path(), 0), "not a PLY file: the first line is not \"ply\"");
    }

    std::string_view nextLine() {
        ++line_;
        const std::size_t end = text_.find(header_.lineEnd, position_);
        if (end == std::string_view::npos) {
            // An ASCII file without any rows may end here. checkCounts checks later that the header declares no rows.
            const std::string_view rest = text_.substr(position_);
            if (text_.size() < file_.size() || wordsOf(rest) != std::vector<std::string_view>{"end_header"})
                throw Error(atByte(file_.path(), text_.size()), "the header has no end_header");
            position_ = text_.size();
            return rest;
        }
        const std::string_view result = text_.substr(position_, end - position_);
        position_ = end + 1;
        return result;
    }

    void statement(const std::vector<std::string_view>& line) {
        if (line[0] == "comment" || line[0] == "obj_info") return;
        if (line[0] == "format") return format(line);
        if (line[0] == "element") return element(line);
        if (line[0] == "property") return property(line);
        if (!header_.elements.empty()) fail("unknown header keyword " + quotedForMessage(line[0]));
    }

    void format(const std::vector<std::string_view>& line) {
        if (format_) fail("a second format");
        const std::string_view name = line.size() == 3 && line[2] == "1.0" ? line[1] : std::string_view();
        if (name == "ascii") format_ = PlyFormat::Ascii;
        if (name == "binary_little_endian") format_ = PlyFormat::BinaryLittleEndian;
        if (name == "binary_big_endian") format_ = PlyFormat::BinaryBigEndian;
        if (!format_) fail("bad format: expected ascii, binary_little_endian or binary_big_endian, version 1.0");
    }

    void element(const std::vector<std::string_view>& line) {
        if (line.size() != 3) fail(R"(bad element: expected "element NAME COUNT")");
        PlyElement element;
        element.name = line[1];
        const char* end = line[2].data() + line[2].size();
        const auto [stop, error] = std::from_chars(line[2].data(), end, element.count);
        if (error != std::errc() || stop != end) fail("bad element count " + quotedForMessage(line[2]));
        header_.elements.push_back(std::move(element));
    }

    void property(const std::vector<std::string_view>& line) {
        if (header_.elements.empty()) fail("a property before any element");
        PlyProperty property;
        property.isList = line.size() > 1 && line[1] == "list";
        if (line.size() != (property.isList ? 5U : 3U))
            fail(R"(bad property: expected "property TYPE NAME" or "property list TYPE TYPE NAME")");
        if (property.isList) property.countType = type(line[2]);
        property.type = type(line[line.size() - 2]);
        property.name = line.back();
        header_.elements.back().properties.push_back(std::move(property));
    }

    PlyType type(std::string_view name) const {
        const auto* found =
            std::find_if(kTypeNames.begin(), kTypeNames.end(), [&](const auto& entry) { return entry.first == name; });
        if (found == kTypeNames.end()) fail("unknown type " + quotedForMessage(name));
        return found->second;
    }

    const InputFile& file_;
    std::string_view text_;
    std::size_t position_ = 0;
    std::uint64_t line_ = 0;
    std::optional<PlyFormat> format_;
    PlyHeader header_;
};

// Throws Error if the file is too short for the numbers of rows that its header declares.
void checkCounts(const InputFile& file, const PlyHeader& header) {
    // In an ASCII file, the last value needs no separator after it.
    std::uint64_t left = file.size() - header.bodyOffset + (header.format == PlyFormat::Ascii ? 1 : 0);
    for (const PlyElement& element : header.elements) {
        const std::uint64_t row = element.minRowBytes(header.format);
        if (row != 0 && element.count > left / row)
            throw Error(
                atByte(file.path(), file.size()),
                "the file ends too early",
                std::to_string(element.count) + " rows of element " + quotedForMessage(element.name),
                "room for at most " + std::to_string(left / row));
        left -= element.count * row;
    }
}

} // namespace

int PlyElement::indexOf(const char* wanted, const char* alias) const {
    for (std::size_t i = 0; i < properties.size(); ++i)
        if (properties[i].name == wanted || properties[i].name == alias) return static_cast<int>(i);
    return -1;
}

bool PlyElement::hasLists() const {
    return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.isList; });
}

std::uint64_t PlyElement::minRowBytes(PlyFormat format) const {
    if (format == PlyFormat::Ascii) return 2 * properties.size();
    std::uint64_t bytes = 0;
    for (const PlyProperty& property : properties)
        bytes += byteSize(property.isList ? property.countType : property.type);
    return bytes;
}

PlyHeader readPlyHeader(const InputFile& file) {
    requireUtf8(file);
    std::string text(std::min(file.size(), kLargestHeader), '\0');
    text.resize(file.readSomeAt(0, std::as_writable_bytes(std::span(text))));
    PlyHeader header = HeaderParser(file, text, std::min<std::size_t>(markBytesOf(file), text.size())).parse();
    checkCounts(file, header);
    return header;
}

} // namespace gnomon::read

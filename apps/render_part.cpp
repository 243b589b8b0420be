#include "apps/render_part.hpp"

#include "io/json_record.hpp"
#include "io/text.hpp"

#include <nlohmann/json.hpp>

#include <stdexcept>

namespace scarp::apps {

void write_part(const std::filesystem::path& file, const RenderPart& part) {
  nlohmann::ordered_json record;
  record["frames"] = part.frames;
  record["lower"] = part.range.lower;
  record["upper"] = part.range.upper;
  record["bands"] = part.range.bands;
  record["values_below"] = part.range.values_below;
  record["values_above"] = part.range.values_above;
  record["view"] = {part.view.lower.x, part.view.lower.y, part.view.upper.x, part.view.upper.y};
  io::write_json(file, record);
}

RenderPart read_part(const std::filesystem::path& file) {
  try {
    const auto record = nlohmann::json::parse(io::read_text(file));
    RenderPart part;
    record.at("frames").get_to(part.frames);
    record.at("lower").get_to(part.range.lower);
    record.at("upper").get_to(part.range.upper);
    record.at("bands").get_to(part.range.bands);
    record.at("values_below").get_to(part.range.values_below);
    record.at("values_above").get_to(part.range.values_above);
    const nlohmann::json& view = record.at("view");
    view.at(0).get_to(part.view.lower.x);
    view.at(1).get_to(part.view.lower.y);
    view.at(2).get_to(part.view.upper.x);
    view.at(3).get_to(part.view.upper.y);
    return part;
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(file.string() + ": is no part of a series: " + error.what());
  }
}

} // namespace scarp::apps

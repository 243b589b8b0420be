// Stages: loads and materials that change during the run.
#include "io/scene_sections.hpp"

#include <functional>
#include <string>

namespace scarp::io {

namespace {

// A ramp that `member` finds in a stage.
template <typename Member>
Option<Stage> ramp(const std::string& key, Member member, const std::string& help) {
  return Declaration<Stage>{
      .key = key,
      .unit = "",
      .allowed = ramp_rule,
      .help = help,
      .read = [=](const toml::node& node, int,
                  Stage& stage) { return read_ramp(node, std::invoke(member, stage)); },
      .write = [=](const Stage& stage, int) { return ramp_json(std::invoke(member, stage)); }};
}

Option<Stage> body_forces() {
  return Declaration<Stage>{
      .key = "body_force",
      .unit = "",
      .allowed = std::string("{ REGION = FACTOR, ... }, each FACTOR ") + ramp_rule,
      .help = "Further multiples of gravity, by region; those not named have 1.",
      .read = [](const toml::node& node, int,
                 Stage& stage) { return read_ramps(node, stage.body_force); },
      .write = [](const Stage& stage, int) -> Json {
        Json values = Json::object();
        for (const auto& [region, factor] : stage.body_force) values[region] = ramp_json(factor);
        return values;
      }};
}

Option<Stage> stage_materials() {
  return Declaration<Stage>{
      .key = "material",
      .unit = "",
      .allowed = "{ REGION = 'MATERIAL', ... }",
      .help =
          "Materials during this stage, by region; those not named keep [[region]]'s. Stress and "
          "state go over.",
      .read = [](const toml::node& node, int,
                 Stage& stage) { return read_names(node, stage.material); },
      .write = [](const Stage& stage, int) -> Json {
        Json values = Json::object();
        for (const auto& [region, material] : stage.material) values[region] = material;
        return values;
      }};
}

Option<Stage> stage_start() {
  const Range range{.at_least = 0};
  return Declaration<Stage>{
      .key = "start_s",
      .unit = "s",
      .allowed = range.text("s"),
      .help = "When it starts, for the reader: the end of the stage before.",
      .read = [range](const toml::node& node, int,
                      Stage& stage) { return read_number(node, range, stage.start.emplace()); },
      .write = [](const Stage& stage, int) -> Json {
        return stage.start ? Json(*stage.start) : Json();
      }};
}

} // namespace

Section<Stage> stage_section() {
  return {.name = "stage",
          .help =
              "A part of the run with its own loads and materials; any number of [[stage]], one "
              "after the other. Without, the run is one stage to time.end_s.",
          .options = {
              name<Stage>("Name in messages and overrides."),
              required(number<Stage>("duration_s", "s", &Stage::duration, {.above = 0},
                                     "How long it lasts.")),
              stage_start(),
              Declaration<Stage>{
                  .key = "until_rest",
                  .unit = "",
                  .allowed = "true or false",
                  .help = "Ends before duration_s is over, once the mass is at rest; "
                          "see time.rest_energy_fraction.",
                  .read = [](const toml::node& node, int,
                             Stage& stage) { return read_truth(node, stage.until_rest); },
                  .write = [](const Stage& stage, int) -> Json { return stage.until_rest; }},
              ramp("gravity", &Stage::gravity,
                   "Multiple of gravity_m_s2, time from the stage's start."),
              body_forces(),
              stage_materials(),
              Declaration<Stage>{
                  .key = "begin_from",
                  .unit = "",
                  .allowed = "a directory with one series, or a .pvd or .vtp file",
                  .help = "The run whose last frame this stage begins from: the same points, all "
                          "fields. Stages before this one are left out.",
                  .read = [](const toml::node& node, int,
                             Stage& stage) { return read_text_value(node, stage.begin_from); },
                  .write = [](const Stage& stage, int) -> Json {
                    return stage.begin_from.empty() ? Json() : Json(stage.begin_from);
                  }},
          }};
}

} // namespace scarp::io

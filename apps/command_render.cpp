// scarp render DIR
#include "apps/commands.hpp"
#include "apps/render_jobs.hpp"
#include "apps/render_part.hpp"

#include "apps/usage.hpp"
#include "io/series.hpp"
#include "render/frame_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <stdexcept>

namespace scarp::apps {

namespace {

/// "all", "last" or a list like 0,3,7-9.  Throws UsageError.
std::vector<std::size_t> chosen_frames(const std::string& words, std::size_t count) {
  std::vector<std::size_t> frames;
  const auto range = [&](std::size_t first, std::size_t last) {
    if (first > last)
      throw UsageError(fmt::format("--frames {}: {}-{} runs backwards", words, first, last));
    for (std::size_t i = first; i <= last; ++i) frames.push_back(i);
  };
  if (words == "all") {
    if (count > 0) range(0, count - 1);
    return frames;
  }
  if (words == "last") {
    if (count > 0) frames.push_back(count - 1);
    return frames;
  }
  const auto number = [&](const std::string& word) {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc() || end != word.data() + word.size())
      throw UsageError(
          fmt::format("--frames {}: '{}' is no frame; give all, last, or a list such as "
                      "0,3,7-9",
                      words, word));
    if (value >= count)
      throw UsageError(
          fmt::format("--frames {}: there is no frame {}; the series has frames 0 to {}", words,
                      value, count - 1));
    return value;
  };
  std::size_t start = 0;
  while (start <= words.size()) {
    const std::size_t comma = std::min(words.find(',', start), words.size());
    const std::string part = words.substr(start, comma - start);
    const std::size_t dash = part.find('-');
    if (dash == std::string::npos)
      frames.push_back(number(part));
    else
      range(number(part.substr(0, dash)), number(part.substr(dash + 1)));
    start = comma + 1;
  }
  return frames;
}

struct RenderArguments {
  std::filesystem::path series;
  std::filesystem::path out;
  render::FrameStyle style;
  std::string frames = "all";
  std::string colours = "viridis";
  std::vector<double> range;
  int jobs = 0;
  std::filesystem::path part; ///< of a process that another one started; its words are this one's
};

void require_field(const io::Frame& frame, const render::Field& field) {
  try {
    render::require_component(frame.column(field.name), field.component);
  } catch (const std::runtime_error& error) {
    throw UsageError(std::string("--field: ") + error.what());
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--component: ") + error.what());
  }
}

/// One range and one view for the whole series, whichever frames are drawn of it.
RenderPart whole_series(const io::SeriesReader& series, std::vector<std::size_t> frames,
                        const RenderArguments& options) {
  const render::FrameStyle& style = options.style;
  std::optional<render::ValueSpread> spread;
  std::optional<render::Box> view;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const io::Frame frame = series.read(i);
    require_field(frame, style.field);
    const render::ValueSpread here = render::value_spread(frame, style.field);
    spread = spread ? render::united(*spread, here) : here;
    view = view ? render::united(*view, render::body_view(frame)) : render::body_view(frame);
  }
  render::ColourRange range = render::round_range(*spread, style.bands);
  if (!options.range.empty()) {
    if (options.range[1] <= options.range[0])
      throw UsageError("--range: the upper end must be above the lower");
    range.lower = options.range[0];
    range.upper = options.range[1];
    range.bands = style.bands;
    range.values_below = spread->least < options.range[0];
    range.values_above = spread->largest > options.range[1];
  }
  return {std::move(frames), range, *view};
}

/// The words of the command line that the command was called with.
std::vector<std::string> words_of(const CLI::App& command) {
  std::vector<std::string> words = {command.get_name()};
  std::vector<std::string> positionals;
  for (const CLI::Option* option : command.get_options()) {
    const std::vector<std::string>& values = option->results();
    if (values.empty()) continue;
    if (option->get_positional()) {
      positionals.insert(positionals.end(), values.begin(), values.end());
    } else if (values.size() == 1) {
      words.push_back(option->get_name() + "=" + values.front());
    } else {
      words.push_back(option->get_name());
      words.insert(words.end(), values.begin(), values.end());
    }
  }
  words.emplace_back("--");
  words.insert(words.end(), positionals.begin(), positionals.end());
  return words;
}

void render_series(RenderArguments options, const std::vector<std::string>& words) {
  const io::SeriesReader series(options.series);
  options.style.colours = render::colour_map(options.colours);
  if (options.out.empty())
    options.out = std::filesystem::is_directory(options.series) ? options.series
                                                                : options.series.parent_path();
  RenderPart part;
  if (options.part.empty()) {
    const std::vector<std::size_t> frames = chosen_frames(options.frames, series.size());
    if (frames.empty()) throw std::runtime_error("the series has no frames");
    part = whole_series(series, frames, options);
    make_directory(options.out);
  } else {
    part = read_part(options.part);
  }
  options.style.range = part.range;
  options.style.view = part.view;

  const auto picture = [&](std::size_t index) {
    return options.out /
           fmt::format("{}_{}_{:06}.png", series.name(), options.style.field.name, index);
  };
  const std::size_t jobs =
      options.part.empty() ? std::min(job_count(options.jobs), part.frames.size()) : 1;
  if (jobs > 1) draw_side_by_side(words, part, jobs);
  for (const std::size_t index : part.frames) {
    if (jobs == 1)
      render::write_png(picture(index), render::render_frame(series.read(index), options.style));
    fmt::print("{}\n", picture(index).string());
  }
}

} // namespace

void add_render(CLI::App& program) {
  const auto options = std::make_shared<RenderArguments>();
  CLI::App* command = program.add_subcommand("render", "Draw frames of a series as PNG pictures.");
  command->add_option("series", options->series, "Directory of a run, or its .pvd file")
      ->required();
  command
      ->add_option("--field", options->style.field.name,
                   "Column to draw; of a vector its magnitude unless --component is given")
      ->capture_default_str();
  command->add_option("--component", options->style.field.component,
                      "Component, from 0, of a vector (x y z), a tensor (xx yy zz xy yz xz) or a "
                      "gradient (xx xy xz yx yy yz zx zy zz)");
  command->add_option("--frames", options->frames, "all, last, or a list such as 0,3,7-9")
      ->capture_default_str();
  command->add_option("--out", options->out,
                      "Directory for the pictures; default: the series' own");
  command
      ->add_option("--range", options->range, "Ends of the colours; default: of the whole series")
      ->expected(2);
  command->add_option("--bands", options->style.bands, "Colour bands, at most")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_option("--colours", options->colours, "viridis, cividis or inferno")
      ->check(CLI::IsMember({"viridis", "cividis", "inferno"}))
      ->capture_default_str();
  command->add_option("--width", options->style.width, "Pixels")
      ->check(CLI::Range(200, 16384))
      ->capture_default_str();
  command->add_option("--height", options->style.height, "Pixels; 0: what the body needs")
      ->check(CLI::Range(0, 16384))
      ->capture_default_str();
  command->add_option("--title", options->style.title, "Words above the picture");
  command->add_flag("--points", options->style.draw_points, "Material points instead of bands");
  add_jobs(*command, options->jobs, "Processes that draw");
  command->add_option("--part", options->part)->group(""); // between the processes of --jobs
  command->footer("Example:\n  scarp render out/pile --field velocity --frames last");
  command->callback([options, command] { render_series(*options, words_of(*command)); });
}

} // namespace scarp::apps

#include "scenes/built_in.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

#include "embedded.hpp"
#include "scenes/formula.hpp"
#include "scenes/json_scene.hpp"
#include "scenes/json_text.hpp"
#include "scenes/made_in_code.hpp"
#include "scenes/validate.hpp"

namespace paperproof::compare {
namespace {

/// A file of `built_in/`, read when something in it is first asked for: most runs ask for one scene.
class File {
 public:
  explicit File(const EmbeddedFile& file) : file_(file) {}
  const Json& json() {
    if (json_.is_null()) json_ = Json::parse(file_.text, nullptr, false);
    if (json_.is_discarded())  // this says what is wrong, and takes longer
      json_ = parse_json(std::string(file_.text), std::string(file_.name));
    return json_;
  }
  /// Whether it may have something of that name.
  [[nodiscard]] bool names(std::string_view name) const {
    return file_.text.find(fmt::format("\"{}\"", name)) != std::string_view::npos;
  }

 private:
  EmbeddedFile file_;
  Json json_;
};

/// In the order of registration.
std::vector<File>& files() {
  static std::vector<File> all(built_in_files.begin() + 1, built_in_files.end());
  return all;
}

/// Those that may have something of that name. Texts are searched once for each name.
const std::vector<File*>& files_naming(std::string_view name) {
  static std::map<std::string, std::vector<File*>, std::less<>> by_name;
  if (const auto found = by_name.find(name); found != by_name.end()) return found->second;
  std::vector<File*>& naming = by_name[std::string(name)];
  for (File& file : files())
    if (file.names(name)) naming.push_back(&file);
  return naming;
}

const Json& base() {
  static const Json file = Json::parse(built_in_files.front().text);
  return file;
}

/// What stands under a key; nothing to go through where nothing does.
const Json& part_of(const Json& object, std::string_view key) {
  static const Json none;
  return object.contains(key) ? object.at(key) : none;
}

/// Null where the file has none of that name under that kind.
const Json* named_in(const Json& file, std::string_view kind, std::string_view name) {
  for (const Json& text : part_of(file, kind))
    if (text.at("name") == name) return &text;
  return nullptr;
}

const Json* named(std::string_view kind, std::string_view name) {
  for (File* file : files_naming(name))
    if (const Json* text = named_in(file->json(), kind, name)) return text;
  return nullptr;
}

/// With all that it shares with others: what every scene begins with, what its file says of all, and what it is like.
/// @param name of a scene, a family or a motion.
Json whole(const Json& file, std::string_view name) {
  const Json* own = nullptr;
  for (const char* kind : {"scenes", "families", "motions"})
    if (own == nullptr) own = named_in(file, kind, name);
  if (own == nullptr) return {};
  Json text;
  if (own->contains("like")) {
    text = whole(file, own->at("like").get<std::string_view>());
  } else {
    text = {{"let", Json::object()}, {"scene", base().at("scene")}};
    for (const char* key : {"let", "scene"}) text[key].merge_patch(file.value(key, Json::object()));
  }
  for (const Json& parameter : part_of(*own, "parameters"))
    text["let"][parameter.at("key").get<std::string>()] = parameter.at("usual");
  text.merge_patch(*own);
  return text;
}

Json whole(std::string_view name) {
  for (File* file : files_naming(name))
    if (Json text = whole(file->json(), name); !text.is_null()) return text;
  throw std::invalid_argument(fmt::format("no built-in scene is called {}", name));
}

BuiltInScene scene_from(const Json& text) {
  BuiltInScene scene{text.at("name"), text.at("description"), text.value("family", ""), {}};
  for (const auto& [key, value] : part_of(text, "set").items()) scene.settings.push_back({key, value});
  return scene;
}

SceneFamily family_from(const Json& text) {
  SceneFamily family{text.at("name"), text.at("description"), {}};
  const auto in = [](const Json& object, const char* key) { return object.at(key).get<std::string_view>(); };
  for (const Json& each : text.at("parameters"))
    family.parameters.push_back(
        {in(each, "key"), in(each, "unit"), each.at("least"), each.at("most"), each.at("usual"), in(each, "meaning")});
  return family;
}

SceneSet set_from(const Json& text) { return {text.at("name"), text.at("description"), text.at("scenes")}; }

/// Of all files, in order.
template <class From>
auto all_from(std::string_view kind, const From& from) {
  std::vector<decltype(from(Json()))> all;
  for (const Json* text : texts_of(kind)) all.push_back(from(*text));
  return all;
}

/// Nothing where there is none of that name.
template <class From>
auto found(std::string_view kind, std::string_view name, const From& from) {
  const Json* text = named(kind, name);
  return text != nullptr ? std::optional(from(*text)) : std::nullopt;
}

/// In the order of `Answer::Of`.
constexpr std::array kinds_of_answers{"place",      "speed",   "farthest", "drift",    "contact", "contacts",
                                      "in_the_air", "settled", "crush",    "crushers", "enter",   "leave"};
static_assert(kinds_of_answers.size() == static_cast<std::size_t>(Answer::Of::leave) + 1);

Answer answer_of(const Json& text) {
  Answer answer;
  std::string of = text.at("of");
  if (of == "x" || of == "y" || of == "speed_x" || of == "speed_y") {
    answer.along = of.back() == 'x' ? Vec2d(1, 0) : Vec2d(0, 1);
    of = of.size() == 1 ? "place" : "speed";
  }
  const auto kind = std::find(kinds_of_answers.begin(), kinds_of_answers.end(), of);
  if (kind == kinds_of_answers.end()) throw std::invalid_argument("no such answer: " + of);
  answer.of = static_cast<Answer::Of>(kind - kinds_of_answers.begin());
  static const std::string file = "a built-in scene";
  const JsonCursor at(text, file);
  answer.at_least = -std::numeric_limits<double>::infinity();
  answer.at_most = -answer.at_least;
  at.take("is", answer.at_least);
  at.take("is", answer.at_most);
  at.take("at_least", answer.at_least);
  at.take("at_most", answer.at_most);
  at.take("gaps", answer.per_metre);
  answer.tolerance = answer.per_metre * Answer::gap;
  at.take("within", answer.tolerance);
  at.take("along", answer.along);
  at.take("after", answer.step);
  at.take("with", answer.with);
  at.take("law", answer.by_law);
  at.take("beyond", answer.clearance);
  if (const auto character = at.find("character"))
    answer.character = character->value() == "all" ? Answer::all : static_cast<std::size_t>(character->integer());
  return answer;
}

}  // namespace

std::vector<Answer> answers_of(const Json& texts) {
  std::vector<Answer> answers;
  const auto add = [&answers](const Json& text) { answers.push_back(answer_of(text)); };
  for (const Json& text : texts) {
    if (text.contains("ends_at")) {
      add({{"of", "x"}, {"is", text["ends_at"].at(0)}});
      add({{"of", "y"}, {"is", text["ends_at"].at(1)}});
    } else if (text.contains("rests_after")) {
      add({{"of", "settled"}, {"at_least", 0}, {"at_most", text["rests_after"]}});
      add({{"of", "speed_x"}, {"is", 0}});
      add({{"of", "speed_y"}, {"is", 0}});
    } else {
      add(text);
    }
  }
  return answers;
}

std::vector<const Json*> texts_of(std::string_view kind) {
  std::vector<const Json*> texts;
  for (File& file : files())
    for (const Json& text : part_of(file.json(), kind)) texts.push_back(&text);
  return texts;
}

const std::vector<BuiltInScene>& built_in_scenes() {
  static const std::vector<BuiltInScene> all = all_from("scenes", scene_from);
  return all;
}

const std::vector<SceneFamily>& scene_families() {
  static const std::vector<SceneFamily> all = all_from("families", family_from);
  return all;
}

const std::vector<SceneSet>& scene_sets() {
  static const std::vector<SceneSet> all = all_from("sets", set_from);
  return all;
}

std::optional<BuiltInScene> find_built_in(std::string_view name) { return found("scenes", name, scene_from); }
std::optional<SceneFamily> find_family(std::string_view name) { return found("families", name, family_from); }
std::optional<SceneSet> find_set(std::string_view name) { return found("sets", name, set_from); }

std::string_view family_of(std::string_view scene) {
  const Json* text = named("scenes", scene);
  if (text == nullptr) return scene;
  return text->contains("family") ? text->at("family").get<std::string_view>() : "";
}

Scene built_in_scene(std::string_view name, std::span<const ParameterSetting> parameters) try {
  Json text = whole(name);
  Values values = constants();
  name_numbers(base().at("let"), values);
  for (const ParameterSetting& parameter : parameters) {
    values[parameter.key] = parameter.value;
    text["let"].erase(parameter.key);
  }
  name_numbers(text["let"], values);
  Json document = computed(text["scene"], values);
  document["paperproof_scene"] = 1;
  document["name"] = name;
  Scene scene = read_json_scene(document, "", std::string(name));
  if (text.contains("made")) {
    make_in_code(computed(text["made"], values), scene);
    check_scene(scene, scene.name);
  }
  scene.answers = answers_of(computed(part_of(text, "answers"), values));
  return scene;
} catch (const std::invalid_argument& error) {
  throw std::invalid_argument(fmt::format("built-in scene {}: {}", name, error.what()));
}

}  // namespace paperproof::compare

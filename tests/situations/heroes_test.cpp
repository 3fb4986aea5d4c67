/// Runs every situation of the folder `heroes`: a hero in a world of Box2D, by the story that the file tells.
#include "situations/bodies.hpp"
#include "situations/situation.hpp"

#include "records/trace.hpp"
#include "support/expected.hpp"

#include <gtest/gtest.h>

namespace paperproof::box2d::hero_test {
namespace {

using nlohmann::json;
using test::Situation;
using test::SituationCase;

json written(const Vec2d& v) { return {v.x(), v.y()}; }
json written(const b2Vec2& v) { return {v.x, v.y}; }

const std::map<std::string, double CharacterDef::*> limits{{"jump_speed", &CharacterDef::jump_speed},
                                                           {"jump_cut", &CharacterDef::jump_cut},
                                                           {"snap", &CharacterDef::snap},
                                                           {"step_height", &CharacterDef::step_height}};
const std::map<ContactChange, const char*> changes{
    {ContactChange::added, "added"}, {ContactChange::persisted, "persisted"}, {ContactChange::removed, "removed"}};
const std::map<StepStatus, const char*> statuses{{StepStatus::moved, "moved"},
                                                 {StepStatus::dropped, "dropped"},
                                                 {StepStatus::stuck, "stuck"},
                                                 {StepStatus::crushed, "crushed"},
                                                 {StepStatus::invalid_input, "invalid_input"}};

CharacterDef character_of(const json& text) {
  CharacterDef def;
  for (const auto& [key, value] : text.items()) {
    if (key == "size")
      def.shape = CharacterShape(compare::box(-value.at(0).get<double>() / 2, -value.at(1).get<double>() / 2,
                                              value.at(0).get<double>() / 2, value.at(1).get<double>() / 2)
                                     .points);
    else
      def.*named(key, limits) = value;
  }
  return def;
}

/// One case of a situation, told from its beginning.
class Play {
 public:
  explicit Play(const SituationCase& situation)
      : situation_(situation), game_(hero_def(situation.scene.value("hero", json::object()))) {
    bodies_.build(situation.scene);
    records_.push_back(record());
  }

  /// @return a sentence for each expectation that is missed.
  std::vector<std::string> tell(const json& part) {
    const std::size_t first = records_.size();
    const json& names = part.value("name", json::object());
    json told = part;
    for (const char* later : {"expect", "name", "each_frame", "while", "because"}) told.erase(later);
    told = compare::computed(told, values());
    act(told);
    const json each_frame = part.value("each_frame", json::object());
    test::refuse_other_keys(each_frame, " let set move jump drop ", "each frame");
    for (int frame = 0; frame < told.value("frames", 0); ++frame) {
      situation_.values["frame"] = frame;
      compare::name_numbers(each_frame.value("let", json::object()), situation_.values);
      if (part.contains("while") && compare::value_of(part["while"], values()) == 0) break;
      json now = told;
      now.update(compare::computed(each_frame, values()));
      bodies_.put(now.value("set", json::object()));
      go(now);
    }
    for (const auto& [name, of] : names.items()) situation_.values[name] = of_last(of);
    situation_.expected = part.value("expect", json::array());
    for (json& expected : situation_.expected)
      if (!expected.contains("steps") && !expected.contains("some")) expected.emplace("step", -1);
    return test::missed(situation_, records_, first);
  }

 private:
  HeroDef hero_def(const json& hero) {
    HeroDef def{.character = character_of(hero.value("character", json::object()))};
    def.position = vector_of<Vec2d>(hero.value("feet", json{0, 1e-6}));
    def.position.y() -= def.character.shape.box().lower.y();
    if (hero.contains("mass")) def.mass = hero["mass"];
    if (hero.contains("push_force")) def.push_force = hero["push_force"];
    def.surface_of = [this](b2Fixture& fixture) { return bodies_.surface_of(fixture); };
    return def;
  }

  /// `null` where there is none.
  json id_of(const b2Fixture* fixture) const {
    for (const auto& [id, known] : bodies_.fixtures)
      if (known == fixture) return id;
    return fixture == nullptr ? json() : json("gone");
  }
  template <class Fixtures>
  json ids_of(const Fixtures& fixtures) const {
    json ids = json::array();
    for (const b2Fixture* fixture : fixtures) ids.push_back(id_of(fixture));
    std::sort(ids.begin(), ids.end());
    return ids;
  }

  /// What the game does before the frames of a part.
  void act(const json& part) {
    const std::map<std::string, std::function<void(const json&)>> acts{
        {"add",
         [&](const json& bodies) {
           for (const json& one : bodies) bodies_.add(one);
         }},
        {"destroy",
         [&](const json& id) {
           b2Body& one = bodies_.body(id);
           bodies_.fixtures.erase(id.get<std::string>());
           game_.world.DestroyBody(&one);
         }},
        {"reshape",
         [&](const json& bodies) {
           for (const json& text : bodies) {
             b2Fixture*& made = bodies_.fixtures.at(text.at("id"));
             b2Body& one = *made->GetBody();
             const std::unique_ptr<const b2Shape> shape = shape_of(text);
             if (shape->GetType() == b2Shape::e_edge) {  // in place
               static_cast<b2EdgeShape&>(*made->GetShape()) = static_cast<const b2EdgeShape&>(*shape);
               continue;
             }
             one.DestroyFixture(made);
             made = one.CreateFixture(shape.get(), 0);
           }
         }},
        {"put", [&](const json& bodies) { bodies_.put(bodies); }},
        {"save", [&](const json&) { saved_ = game_.hero.save(); }},
        {"restore", [&](const json&) { game_.hero.restore(saved_.value()); }},
        {"shift_origin",
         [&](const json& by) {
           game_.world.ShiftOrigin(vector_of<b2Vec2>(by));
           game_.hero.shift_origin(vector_of<Vec2d>(by));
         }},
        {"change", [&](const json& text) { has_changed_ = game_.hero.change(character_of(text)); }},
        {"place",
         [&](const json& to) {
           game_.hero.place(vector_of<Vec2d>(to.at("at")), vector_of<Vec2d>(to.value("velocity", json{0, 0})));
         }},
        {"set_velocity", [&](const json& velocity) { game_.hero.set_velocity(vector_of<Vec2d>(velocity)); }},
        {"knock_back", [&](const json& velocity) { game_.hero.knock_back(vector_of<Vec2d>(velocity)); }}};
    for (const auto& [key, what] : part.items())
      if (key != "frames" && key != "move" && key != "jump" && key != "drop") named(key, acts)(what);
    if (!part.contains("frames")) records_.push_back(record());
  }

  void go(const json& now) {
    const json move = now.value("move", json(0));
    game_.listener.solved = 0;
    game_.go({.move = move.is_null() ? std::optional<double>() : move.get<double>(),
              .jump = test::is_true(now.value("jump", json(false))),
              .drop = test::is_true(now.value("drop", json(false)))});
    records_.push_back(record());
  }

  [[nodiscard]] json record() const {
    const Hero& hero = game_.hero;
    json contacts = json::array();
    for (const HeroContact& contact : hero.contacts())
      contacts.push_back({{"with", id_of(contact.fixture)}, {"change", changes.at(contact.change)}});
    json sensors = json::array();
    for (const HeroSensorEvent& event : hero.sensors())
      sensors.push_back({{"sensor", id_of(event.sensor)}, {"change", std::string(compare::name_of(event.change))}});
    json bodies = json::object();
    json begun = json::object();
    for (const auto& [id, fixture] : bodies_.fixtures) {
      const b2Body& body = *fixture->GetBody();
      bodies[id] = {{"at", written(body.GetPosition())},
                    {"angle", body.GetAngle()},
                    {"velocity", written(body.GetLinearVelocity())},
                    {"speed", body.GetLinearVelocity().Length()}};
      begun[id] = game_.times_begun(*fixture);
    }
    return {{"status", statuses.at(hero.report().status)},
            {"path", {written(hero.position())}},
            {"feet", hero.position().y() + hero.save().character.shape.box().lower.y()},
            {"velocity", written(hero.velocity())},
            {"grounded", hero.grounded()},
            {"ground", id_of(hero.ground())},
            {"rides", hero.state().ride.ground != Ride::none},
            {"contacts", contacts},
            {"touching", ids_of(game_.listener.touching)},
            {"begun", begun},
            {"solved", game_.listener.solved},
            {"sensors", sensors},
            {"inside", ids_of(hero.inside())},
            {"crushed_by", ids_of(hero.crushed_by())},
            {"skipped", ids_of(hero.skipped())},
            {"has_changed", has_changed_},
            {"bodies", bodies}};
  }

  /// A number of the last record, by its path or a formula.
  [[nodiscard]] double of_last(const std::string& of) const {
    return of.starts_with('=') ? compare::value_of(of.substr(1), values())
                               : test::part_of(records_.back(), of).get<double>();
  }
  [[nodiscard]] compare::Values values() const {
    return test::in_step(static_cast<int>(records_.size()) - 1, records_, situation_.values);
  }

  SituationCase situation_;
  std::vector<json> records_;
  std::optional<HeroSave> saved_;
  bool has_changed_ = false;
  Game game_;
  Bodies bodies_{game_};
};

class HeroSituations : public ::testing::TestWithParam<Situation> {};

TEST_P(HeroSituations, come_to_what_they_must) {
  for (const SituationCase& situation : test::some_cases_of(GetParam())) {
    Play play(situation);
    for (std::size_t k = 0; k < situation.expected.size(); ++k) {
      for (const std::string& sentence : play.tell(situation.expected[k]))
        ADD_FAILURE() << GetParam().name << situation.title << ", part " << k << " of its story: " << sentence;
    }
    ASSERT_FALSE(HasFailure());
  }
}

INSTANTIATE_TEST_SUITE_P(All, HeroSituations,
                         ::testing::ValuesIn(test::read_situations(PAPERPROOF_SITUATIONS "/heroes")),
                         [](const auto& situation) { return situation.param.file + "_" + situation.param.name; });

}  // namespace
}  // namespace paperproof::box2d::hero_test

/// Runs every situation of the folder `heroes`: a hero in a world of Box2D, by the story that the file tells.
#include "situations/situation.hpp"

#include "box2d_adapter/hero_world.hpp"
#include "records/trace.hpp"
#include "support/expected.hpp"

#include <gtest/gtest.h>

namespace paperproof::box2d::hero_test {
namespace {

using nlohmann::json;
using test::Situation;
using test::SituationCase;

template <class Vector>
Vector vector_of(const json& two) {
  return Vector(two.at(0), two.at(1));
}
json written(const Vec2d& v) { return {v.x(), v.y()}; }
json written(const b2Vec2& v) { return {v.x, v.y}; }

/// What one of a few words of a file stands for.
template <class Value>
Value named(const std::string& word, const std::map<std::string, Value>& words) {
  const auto found = words.find(word);
  if (found == words.end()) throw std::invalid_argument("no such word: " + word);
  return found->second;
}

const std::map<std::string, b2BodyType> types{
    {"static", b2_staticBody}, {"kinematic", b2_kinematicBody}, {"dynamic", b2_dynamicBody}};
const std::map<std::string, Blocking> blockings{{"as_in_box2d", Blocking::as_in_box2d},
                                                {"from_above", Blocking::from_above},
                                                {"from_everywhere", Blocking::from_everywhere},
                                                {"not_at_all", Blocking::not_at_all}};
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

std::unique_ptr<b2Shape> shape_of(const json& body) {
  std::vector<b2Vec2> points;
  for (const char* kind : {"polygon", "edge", "chain", "loop"})
    for (const json& each : body.value(kind, json::array())) points.push_back(vector_of<b2Vec2>(each));
  const int count = static_cast<int>(points.size());
  if (body.contains("circle")) {
    auto circle = std::make_unique<b2CircleShape>();
    circle->m_radius = body["circle"];
    return circle;
  }
  if (body.contains("polygon")) {
    auto polygon = std::make_unique<b2PolygonShape>();
    if (count == 4 && points[0] == -points[2] && points[0].x == points[3].x)
      polygon->SetAsBox(points[2].x, points[2].y);  // its corners in Box2D's own order
    else
      polygon->Set(points.data(), count);
    return polygon;
  }
  const b2Vec2 before = points.at(0) + points[0] - points.at(1);
  const b2Vec2 after = points.back() + points.back() - points[points.size() - 2];
  if (body.contains("edge")) {
    auto edge = std::make_unique<b2EdgeShape>();
    edge->SetTwoSided(points[0], points[1]);
    if (body.value("one_sided", false)) edge->SetOneSided(before, points[0], points[1], after);
    return edge;
  }
  auto chain = std::make_unique<b2ChainShape>();
  if (body.contains("loop")) chain->CreateLoop(points.data(), count);
  if (body.contains("chain")) chain->CreateChain(points.data(), count, before, after);
  return chain;
}

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
    for (const json& body : situation.scene.at("bodies")) add(body);
    for (const json& joint : situation.scene.value("joints", json::array())) {
      b2RevoluteJointDef def;
      def.Initialize(&body(joint.at("bodies").at(0)), &body(joint.at("bodies").at(1)),
                     vector_of<b2Vec2>(joint.at("at")));
      def.enableMotor = joint.contains("motor");
      def.maxMotorTorque = joint.value("motor", 0.0F);
      game_.world.CreateJoint(&def);
    }
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
    for (int frame = 0; frame < told.value("frames", 0); ++frame) {
      situation_.values["frame"] = frame;
      compare::name_numbers(each_frame.value("let", json::object()), situation_.values);
      if (part.contains("while") && compare::value_of(part["while"], values()) == 0) break;
      json now = told;
      now.update(compare::computed(each_frame, values()));
      put(now.value("set", json::object()));
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
    def.surface_of = [this](b2Fixture& fixture) { return surfaces_[&fixture]; };
    return def;
  }

  b2Fixture& fixture(const std::string& id) {
    const auto found = fixtures_.find(id);
    if (found == fixtures_.end()) throw std::invalid_argument("no such body: " + id);
    return *found->second;
  }
  b2Body& body(const std::string& id) { return *fixture(id).GetBody(); }
  /// `null` where there is none.
  json id_of(const b2Fixture* fixture) const {
    for (const auto& [id, known] : fixtures_)
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

  void add(const json& text) {
    b2Fixture& made =
        game_.add(named(text.value("type", "static"), types), vector_of<b2Vec2>(text.value("at", json{0, 0})),
                  *shape_of(text), text.value("density", 1.0F));
    made.SetSensor(text.value("sensor", false));
    made.GetBody()->SetBullet(text.value("bullet", false));
    if (text.value("weightless", false)) made.GetBody()->SetGravityScale(0);
    made.GetBody()->SetAngularDamping(text.value("angular_damping", 0.0F));
    surfaces_[&made].blocks = named(text.value("blocks", "as_in_box2d"), blockings);
    const std::string id = text.at("id");
    fixtures_[id] = &made;
    json rest = text;
    rest.erase("at");
    put({{id, rest}});
  }

  /// Bodies come to be somewhere at once, or get another speed.
  void put(const json& bodies) {
    for (const auto& [id, text] : bodies.items()) {
      b2Body& one = body(id);
      if (text.contains("at") || text.contains("angle"))
        one.SetTransform(text.contains("at") ? vector_of<b2Vec2>(text["at"]) : one.GetPosition(),
                         text.value("angle", one.GetAngle()));
      if (text.contains("velocity")) one.SetLinearVelocity(vector_of<b2Vec2>(text["velocity"]));
      if (text.contains("spin")) one.SetAngularVelocity(text["spin"]);
      if (text.contains("surface_speed")) surfaces_[&fixture(id)].speed = text["surface_speed"];
      if (text.contains("motor"))
        static_cast<b2RevoluteJoint*>(one.GetJointList()->joint)->SetMotorSpeed(text["motor"]);
    }
  }

  /// What the game does before the frames of a part.
  void act(const json& part) {
    const std::map<std::string, std::function<void(const json&)>> acts{
        {"add",
         [&](const json& bodies) {
           for (const json& one : bodies) add(one);
         }},
        {"destroy",
         [&](const json& id) {
           b2Body& one = body(id);
           fixtures_.erase(id.get<std::string>());
           game_.world.DestroyBody(&one);
         }},
        {"reshape",
         [&](const json& bodies) {
           for (const json& text : bodies) {
             b2Fixture*& made = fixtures_.at(text.at("id"));
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
        {"put", [&](const json& bodies) { put(bodies); }},
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
    for (const auto& [id, fixture] : fixtures_) {
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
  std::map<std::string, b2Fixture*> fixtures_;
  std::map<const b2Fixture*, Surface> surfaces_;
  std::vector<json> records_;
  std::optional<HeroSave> saved_;
  bool has_changed_ = false;
  Game game_;
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

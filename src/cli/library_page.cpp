#include "cli/library_page.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/markup.h"
#include "io/filmstrip.h"
#include "io/graph_picture.h"
#include "scene/library_check.h"
#include "scene/sparring_files.h"

namespace ringcraft {

namespace {

constexpr std::size_t kMostNamed = 24;  // actions that an action leads to, by name

// What is under the pointer in a graph, and its two actions on a click.
constexpr const char* kHead =
    R"(<!doctype html><meta charset="utf-8"><title>Motion library {0}</title>
<style>body{{font:14px system-ui;margin:2em}}table{{border-collapse:collapse}}
td,th{{padding:.2em .7em;border-bottom:1px solid #ccc;text-align:right}}
td:first-child,td:last-child,th:first-child{{text-align:left}}
.exchanges td,.exchanges th{{font-size:12px;padding:.1em .4em;border:1px solid #ddd}}
.exchanges thead th{{writing-mode:vertical-rl;text-align:left}}
.wide{{overflow:auto;max-height:95vh;border:1px solid #ddd;margin:.5em 0}}
article{{margin:2.5em 0 0;border-top:1px solid #999}}article>svg{{display:block}}
.film{{content-visibility:auto;contain-intrinsic-size:1400px 380px;overflow-x:auto}}
.key i{{display:inline-block;width:1em;height:1em;margin:0 .3em 0 1em;vertical-align:-.15em}}
#under{{position:fixed;left:0;bottom:0;background:#222;color:#fff;padding:.3em .8em}}</style>
<h1>Motion library {0}</h1>
<p><a href="#graph">action graph</a> &middot; <a href="#motion">motion graph</a> &middot;
<a href="#table">offense/defense table</a> &middot; <a href="#actions">actions</a> &middot;
<a href="#notes">notes and evidence</a></p>
)";

constexpr const char* kScript = R"(<div id="under" hidden></div><script>
for (const graph of document.querySelectorAll('svg.graph')) {
  const names = [...graph.parentNode.querySelectorAll('.names')][0].textContent.trim().split('\n');
  const at = Number(graph.dataset.at), cell = Number(graph.dataset.cell);
  const under = document.getElementById('under');
  const pair = event => {
    const box = graph.getBoundingClientRect();
    return [names[Math.floor((event.clientY - box.top - at) / cell)],
            names[Math.floor((event.clientX - box.left - at) / cell)]];
  };
  graph.onmousemove = event => {
    const [from, to] = pair(event);
    under.hidden = !from || !to;
    under.textContent = `${from} → ${to}`;
  };
  graph.onmouseleave = () => { under.hidden = true; };
  graph.onclick = event => { const [from] = pair(event); if (from) location.hash = 'a-' + from; };
}
</script>
)";

std::string link_to(const Action& action) {
  return fmt::format("<a href=\"#a-{0}\">{0}</a>", escaped(action.name));
}

// The action of measure()'s entry i: one of the library, or one of its changes of stance.
const Action& measured(const MotionLibrary& library, std::size_t i) {
  const std::size_t own = library.actions().size();
  return i < own ? library.actions()[i] : library.switches()[i - own];
}

std::string table_rows(const MotionLibrary& library, const std::vector<ActionMeasures>& measures) {
  std::string rows;
  for (std::size_t i = 0; i < measures.size(); ++i) {
    const ActionMeasures& m = measures[i];
    if (measured(library, i).connects) continue;
    rows += fmt::format(
        "<tr><td>{}<td>{}<td>{:.2f}<td>{:.2f}<td>{:.1f}<td>{:.2f}<td>{:.0f}<td>{:.3f}<td>{}<td>{}</"
        "tr>\n",
        link_to(measured(library, i)), name_of(m.kind), m.seconds, m.strike_begin_s,
        m.peak_speed_mps, m.travel_m, degrees(static_cast<float>(m.turn_rad)), m.foot_skate,
        m.leads_to, escaped(m.source));
  }
  return rows;
}

std::string list_of(const char* title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string list = fmt::format("<h2>{}</h2><ul>\n", title);
  for (const std::string& line : lines) list += fmt::format("<li>{}\n", escaped(line));
  return list + "</ul>\n";
}

std::string key_of(const GraphPicture& picture, const std::vector<const char*>& meanings) {
  std::string key = "<p class=\"key\">";
  for (std::size_t i = 0; i < meanings.size(); ++i)
    key += fmt::format("<i style=\"background:{}\"></i>{}", picture.shades[i], meanings[i]);
  return key + "</p>\n";
}

std::string framed(const GraphPicture& picture, const char* id) {
  std::string names;
  for (const std::string& name : picture.names) names += escaped(name) + "\n";
  return fmt::format("<div class=\"wide\"><div class=\"names\" hidden>{}</div>{}</div>\n", names,
                     picture_svg(picture, id));
}

std::string graphs_of(const MotionLibrary& library) {
  const GraphPicture actions = action_graph(library);
  std::string text = fmt::format(
      "<h2 id=\"graph\">Action graph</h2><p>From the end of the row's action to the start of the "
      "column's. Responses, falls and get-ups are entered by physics only. A click leads to the "
      "row's action.</p>\n{}{}",
      key_of(actions, {"directly", "up to 0.25 s on the way", "up to 1 s", "later"}),
      framed(actions, "action-graph"));
  const MotionGraph& graph = library.graph();
  text += "<h2 id=\"motion\">Motion graph</h2>";
  if (graph.clips.empty())
    return text + "<p>None: it is the work of <code>ringcraft library build</code>.</p>\n";
  const auto connecting = std::count_if(library.actions().begin(), library.actions().end(),
                                        [](const Action& action) { return action.connects; });
  const GraphPicture clips = clip_graph(library);
  return text + fmt::format(
                    "<p>{} transitions between {} clips, of {} local minima under the thresholds, "
                    "{} of them outside of the largest strongly connected component; {} short ways "
                    "through it connect actions. Transitions from the row's clip into the "
                    "column's:</p>\n{}{}",
                    graph.transitions.size(), graph.clips.size(), graph.minima, graph.dropped,
                    connecting, key_of(clips, {"1", "2 to 4", "5 to 16", "more"}),
                    framed(clips, "motion-graph"));
}

// The phases of an action along its time, and in words.
struct Phases {
  const Action& action;
  std::string bars, words;

  void add(Tick begin, Tick end, const char* colour, const std::string& name) {
    constexpr double kPixels = 300;  // of a second
    if (end <= begin) return;
    bars += fmt::format("<rect x='{:.0f}' width='{:.0f}' height='14' fill='{}'/>",
                        seconds(begin) * kPixels, std::max(1.0, seconds(end - begin) * kPixels),
                        colour);
    words += fmt::format("{}{} {:.2f}-{:.2f} s", words.empty() ? "" : ", ", name, seconds(begin),
                         seconds(end));
  }
  std::string html() const {
    return fmt::format("<svg width='{:.0f}' height='14'>{}</svg><p>{}</p>",
                       seconds(action.length()) * 300, bars, words);
  }
};

std::string phases_of(const Action& action) {
  constexpr const char *kStartup = "#e8c46a", *kActive = "#d04a3a", *kRecovery = "#9fb7d6",
                       *kProtects = "#5fae7b", *kOther = "#d5d8dd";
  Phases phases{action, "", ""};
  Tick done = 0;
  for (const Strike& strike : action.strikes) {
    phases.add(done, strike.active_begin, kStartup, "startup");
    phases.add(std::max(done, strike.active_begin), strike.active_end, kActive,
               fmt::format("active ({} {} to the {})", vrm_name(strike.joint), name_of(strike.kind),
                           name_of(strike.zone)));
    done = std::max(done, strike.active_end);
  }
  if (action.attacks()) {
    phases.add(std::min(done, action.length()), action.length(), kRecovery, "recovery");
  } else if (action.defense) {
    phases.add(0, action.defense->begin, kStartup, "startup");
    phases.add(action.defense->begin, action.defense->end, kProtects,
               fmt::format("protects ({})", name_of(action.defense->kind)));
    phases.add(action.defense->end, action.length(), kRecovery, "recovery");
  } else {
    phases.add(0, action.length(), kOther, std::string(name_of(action.kind)));
  }
  return phases.html();
}

std::string leads_to(const MotionLibrary& library, ActionId from) {
  std::string list;
  std::size_t named = 0, more = 0;
  for (const Edge& edge : library.machine().edges(from)) {
    const Action& to = library.action(edge.to);
    if (to.connects) continue;
    if (named == kMostNamed) {
      ++more;
      continue;
    }
    list += fmt::format("{}{} ({:.0f} cm)", named++ > 0 ? ", " : "", link_to(to),
                        edge.alignment.distance * 100);
  }
  if (more > 0) list += fmt::format(" and {} more", more);
  const std::vector<std::string>& said = library.action(from).leads_to;
  const std::string sheet =
      said.empty()
          ? ""
          : fmt::format(" (its sheet: {})", escaped(fmt::format("{}", fmt::join(said, ", "))));
  return fmt::format("<p>leads directly to{}: {}</p>\n", sheet, list.empty() ? "nothing" : list);
}

std::string strike_speeds(const std::vector<StrikeMeasures>& strikes, const Action& action) {
  std::string text;
  for (const StrikeMeasures& m : strikes) {
    if (m.action != action.name) continue;
    text += fmt::format("; {} peak {:.1f} m/s, {:.1f} against the pelvis", name_of(m.strike.kind),
                        m.peak_world, m.peak_to_pelvis);
    if (m.lands_to > 0)
      text += fmt::format(", lands at {:.1f} m/s, {:.2f} s in, from {:.2f}-{:.2f} m", m.impact,
                          m.start_to_contact_s, m.lands_from, m.lands_to);
  }
  return text;
}

std::string actions_of(const MotionLibrary& library, const std::vector<ActionMeasures>& measures) {
  const std::vector<StrikeMeasures> strikes = measure_strikes(library);
  std::string text;
  for (std::size_t i = 0; i < measures.size(); ++i) {
    const Action& action = measured(library, i);
    if (action.connects) continue;
    const ActionMeasures& m = measures[i];
    text += fmt::format(
        "<article id=\"a-{0}\"><h3>{0}</h3><p>{1}, {2:.2f} s, travels {3:.2f} m at {4:.2f} m/s, "
        "turns {5:.0f} degrees{6}; {7}</p>\n",
        escaped(action.name), name_of(action.kind), m.seconds, m.travel_m,
        m.travel_m / std::max(m.seconds, 0.01), degrees(static_cast<float>(m.turn_rad)),
        strike_speeds(strikes, action), escaped(action.source));
    text += phases_of(action);
    if (!action.switches) text += leads_to(library, ActionId(i));
    text += fmt::format("<div class=\"film\">{}</div></article>\n",
                        filmstrip_svg(library.skeleton(), {action}));
  }
  return text;
}

}  // namespace

std::string library_page(const MotionLibrary& library, const OffenseDefenseTable& table) {
  const std::vector<ActionMeasures> measures = measure(library);
  std::string page = fmt::format(kHead, escaped(library.name()));
  page += fmt::format("<p>{} actions:", library.actions().size());
  for (const Kind kind : {Kind::attack, Kind::combination, Kind::defense, Kind::transition,
                          Kind::idle, Kind::response, Kind::get_up})
    page += fmt::format(" {} {},", library.count(kind), name_of(kind));
  page.back() = '.';
  page += "</p>\n" + graphs_of(library);
  page += "<h2 id=\"table\">Offense/defense table</h2>";
  page += table.empty()
              ? "<p>No attack met a defense.</p>\n"
              : "<div class=\"wide\">" + table_html(library.actions(), table) + "</div>\n";
  page += fmt::format(
      "<h2 id=\"actions\">Actions</h2><table><tr><th>action<th>kind<th>s<th>hits from s<th>peak "
      "m/s<th>travel m<th>turn deg<th>foot skate<th>leads to<th>source</tr>\n{}</table>\n",
      table_rows(library, measures));
  page += actions_of(library, measures);
  page += "<div id=\"notes\"></div>" + list_of("Dropped", library.dropped()) +
          list_of("Notes and evidence", library.notes());
  return page + kScript;
}

}  // namespace ringcraft

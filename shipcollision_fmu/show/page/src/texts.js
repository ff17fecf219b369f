// Texts in four languages, those of the live pages and those that all pages have, and what puts them on the page.
// A text may have places for values: {name}. The language is the browser's until somebody chooses.

export const LANGUAGES = { en: "English", de: "Deutsch", nb: "Norsk", zh: "中文" };
const ORDER = ["en", "de", "nb", "zh"];

export const TEXTS = {
  // Pages and command
  bridge_title: ["Bridge of {ship}", "Brücke von {ship}", "Broen på {ship}", "{ship} 驾驶台"],
  instructor_title: ["Instructor", "Ausbilder", "Instruktør", "教练员"],
  in_command: ["You are in command.", "Sie haben das Kommando.", "Du har kommandoen.", "您正在指挥。"],
  other_in_command: ["{client} is in command.", "{client} hat das Kommando.", "{client} har kommandoen.", "{client} 正在指挥。"],
  nobody_in_command: ["Nobody is in command.", "Niemand hat das Kommando.", "Ingen har kommandoen.", "无人指挥。"],
  follows_recording: ["This ship follows a recorded track.", "Dieses Schiff folgt einer aufgezeichneten Bahn.", "Dette skipet følger et registrert spor.", "本船按记录的航迹航行。"],
  takes_no_orders: ["This ship takes no orders.", "Dieses Schiff nimmt keine Befehle an.", "Dette skipet tar ikke imot ordrer.", "本船不接受指令。"],
  no_such_ship: [
    "There is no ship {ship}. The ships are {ships}.",
    "Es gibt kein Schiff {ship}. Die Schiffe sind {ships}.",
    "Det finnes ikke noe skip {ship}. Skipene er {ships}.",
    "没有船舶 {ship}。船舶有：{ships}。",
  ],
  take_command: ["Take command", "Kommando übernehmen", "Ta kommandoen", "接管指挥"],
  release_command: ["Release command", "Kommando abgeben", "Gi fra deg kommandoen", "交出指挥"],
  language: ["Language", "Sprache", "Språk", "语言"],
  theme: ["Light or dark", "Hell oder dunkel", "Lys eller mørk", "浅色或深色"],
  help: ["Keys", "Tasten", "Taster", "按键"],
  close: ["Close", "Schließen", "Lukk", "关闭"],
  connecting: ["Connecting to the simulation", "Verbindung zur Simulation wird hergestellt", "Kobler til simuleringen", "正在连接仿真"],
  ended: ["The run has ended.", "Der Lauf ist beendet.", "Kjøringen er avsluttet.", "运行已结束。"],
  stored_in: ["Stored in {folder}. To see it later:", "Gespeichert in {folder}. Später zu sehen mit:", "Lagret i {folder}. For å se den senere:", "已保存于 {folder}。以后查看："],
  server_gone: ["The server has ended as well.", "Auch der Server ist beendet.", "Serveren er også avsluttet.", "服务器也已关闭。"],
  debriefing: ["Debriefing", "Nachbesprechung", "Gjennomgang", "复盘"],
  refused: ["Not done: {message}", "Nicht ausgeführt: {message}", "Ikke utført: {message}", "未执行：{message}"],
  no_picture: [
    "The picture cannot be shown ({message}); chart and controls work.",
    "Das Bild kann nicht gezeigt werden ({message}); Karte und Bedienung arbeiten.",
    "Bildet kan ikke vises ({message}); kart og betjening virker.",
    "无法显示画面（{message}）；海图和操纵可用。",
  ],
  picture: ["View from the ship", "Blick vom Schiff", "Utsikt fra skipet", "船上视景"],

  // Instruments
  instruments: ["Instruments", "Instrumente", "Instrumenter", "仪表"],
  heading_short: ["HDG", "HDG", "HDG", "艏向"],
  rot: ["ROT", "ROT", "ROT", "转向率"],
  sog: ["SOG", "SOG", "SOG", "对地航速"],
  cog: ["COG", "COG", "COG", "对地航向"],
  log: ["LOG", "Logge", "Logg", "计程仪"],
  rpm: ["Shaft", "Welle", "Aksel", "轴转速"],
  rudder: ["Rudder", "Ruder", "Ror", "舵角"],
  port_short: ["P {value}°", "Bb {value}°", "Bb {value}°", "左 {value}°"],
  starboard_short: ["S {value}°", "Stb {value}°", "Stb {value}°", "右 {value}°"],
  per_minute: ["°/min", "°/min", "°/min", "°/min"],
  knots: ["kn", "kn", "kn", "节"],
  rpm_unit: ["rpm", "1/min", "o/min", "转/分"],
  through_water: ["Speed through the water", "Fahrt durchs Wasser", "Fart gjennom vannet", "对水速度"],

  // Conning
  conning: ["Steering and engine", "Ruder und Maschine", "Styring og maskin", "操舵与主机"],
  wheel: ["Wheel", "Steuerrad", "Ratt", "舵轮"],
  port_5: ["5° to port", "5° nach Backbord", "5° babord", "左舵 5°"],
  starboard_5: ["5° to starboard", "5° nach Steuerbord", "5° styrbord", "右舵 5°"],
  midships: ["Midships", "Mittschiffs", "Midtskips", "正舵"],
  port_value: ["Port {value}°", "Backbord {value}°", "Babord {value}°", "左舵 {value}°"],
  starboard_value: ["Starboard {value}°", "Steuerbord {value}°", "Styrbord {value}°", "右舵 {value}°"],
  telegraph: ["Engine telegraph", "Maschinentelegraf", "Maskintelegraf", "车钟"],
  telegraph_4: ["Full ahead", "Voll voraus", "Full forover", "前进四"],
  telegraph_3: ["Half ahead", "Halbe voraus", "Halv forover", "前进三"],
  telegraph_2: ["Slow ahead", "Langsam voraus", "Sakte forover", "前进二"],
  telegraph_1: ["Dead slow ahead", "Ganz langsam voraus", "Dødsakte forover", "前进一"],
  telegraph_0: ["Stop", "Stopp", "Stopp", "停车"],
  "telegraph_-1": ["Dead slow astern", "Ganz langsam zurück", "Dødsakte akterover", "后退一"],
  "telegraph_-2": ["Slow astern", "Langsam zurück", "Sakte akterover", "后退二"],
  "telegraph_-3": ["Half astern", "Halbe zurück", "Halv akterover", "后退三"],
  "telegraph_-4": ["Full astern", "Voll zurück", "Full akterover", "后退四"],
  autopilot: ["Autopilot", "Autopilot", "Autopilot", "自动舵"],
  autopilot_short: ["Auto", "Auto", "Auto", "自动"],
  course_to_steer: ["Heading to steer [°]", "Sollkurs [°]", "Kurs å styre [°]", "设定航向 [°]"],
  steer: ["Steer", "Steuern", "Styr", "执行"],
  change_heading: ["Heading {value}°", "Kurs {value}°", "Kurs {value}°", "航向 {value}°"],
  horn: ["Horn", "Typhon", "Tåkelur", "汽笛"],
  no_controls: [
    "This ship has neither rudder nor engine to order.",
    "Dieses Schiff hat weder Ruder noch Maschine.",
    "Dette skipet har verken ror eller maskin.",
    "本船没有可操纵的舵和主机。",
  ],

  // Alarms
  alarms: ["Alarms", "Alarme", "Alarmer", "报警"],
  acknowledge: ["Acknowledge", "Quittieren", "Kvitter", "确认"],
  alarm_contact: ["Collision: {a} and {b}", "Kollision: {a} und {b}", "Kollisjon: {a} og {b}", "碰撞：{a} 与 {b}"],
  alarm_cpa: ["{ship}: CPA {cpa}, TCPA {tcpa}", "{ship}: CPA {cpa}, TCPA {tcpa}", "{ship}: CPA {cpa}, TCPA {tcpa}", "{ship}：CPA {cpa}，TCPA {tcpa}"],
  alarm_cpa_over: ["{ship}: CPA no longer below the limits", "{ship}: CPA nicht mehr unter den Grenzen", "{ship}: CPA ikke lenger under grensene", "{ship}：CPA 已不低于限值"],
  alarm_blackout: ["Blackout: no engine", "Blackout: keine Maschine", "Blackout: ingen maskin", "全船失电：主机失效"],
  alarm_rudder: ["Rudder stuck", "Ruder klemmt", "Roret sitter fast", "卡舵"],
  alarm_lost: ["Connection lost. Connecting again", "Verbindung verloren. Neuer Versuch", "Forbindelsen er brutt. Kobler til igjen", "连接中断，正在重连"],
  alarm_slow: ["Simulation cannot keep up: {rate}×", "Simulation kommt nicht nach: {rate}×", "Simuleringen henger etter: {rate}×", "仿真跟不上：{rate}×"],
  limits: ["Alarm limits", "Alarmgrenzen", "Alarmgrenser", "报警限值"],
  cpa_limit: ["CPA [NM]", "CPA [sm]", "CPA [nm]", "CPA [海里]"],
  tcpa_limit: ["TCPA [min]", "TCPA [min]", "TCPA [min]", "TCPA [分]"],
  sound_waits: ["Click for sound", "Klicken für Ton", "Klikk for lyd", "点击以开启声音"],

  // Chart
  chart: ["Chart", "Karte", "Kart", "海图"],
  north_up: ["North up", "Nord oben", "Nord opp", "北向上"],
  head_up: ["Head up", "Voraus oben", "Forut opp", "艏向上"],
  range_in: ["Smaller range", "Kleinerer Bereich", "Mindre område", "缩小量程"],
  range_out: ["Larger range", "Größerer Bereich", "Større område", "扩大量程"],
  chart_large: ["Chart in place of the picture", "Karte statt Bild", "Kart i stedet for bilde", "海图与画面切换"],
  vectors: ["Vectors {minutes} min", "Vektoren {minutes} min", "Vektorer {minutes} min", "矢量 {minutes} 分"],
  targets: ["Other ships", "Andere Schiffe", "Andre skip", "其他船舶"],
  target: ["Ship", "Schiff", "Skip", "船舶"],
  bearing: ["Bearing", "Peilung", "Peiling", "方位"],
  range: ["Range", "Abstand", "Avstand", "距离"],
  miles: ["NM", "sm", "nm", "海里"],
  no_targets: ["There is no other ship.", "Es gibt kein anderes Schiff.", "Det er ingen andre skip.", "没有其他船舶。"],

  // Cameras
  camera: ["Camera", "Kamera", "Kamera", "视角"],
  camera_bridge: ["Bridge", "Brücke", "Bro", "驾驶台"],
  camera_port: ["Port wing", "Backbordnock", "Babord brovinge", "左桥翼"],
  camera_starboard: ["Starboard wing", "Steuerbordnock", "Styrbord brovinge", "右桥翼"],
  camera_chase: ["Chase", "Verfolger", "Følgekamera", "跟随"],
  camera_outside: ["Outside", "Außen", "Utenfra", "外部"],
  camera_all: ["Overview", "Übersicht", "Oversikt", "全景"],
  binoculars: ["Binoculars", "Fernglas", "Kikkert", "望远镜"],
  plain: ["Plain sea, for weak computers", "Einfache See, für schwache Rechner", "Enkel sjø, for svake maskiner", "简化海面（低性能电脑）"],
  full_screen: ["Full screen", "Vollbild", "Fullskjerm", "全屏"],
  sky: ["Time of day", "Tageszeit", "Tid på døgnet", "时段"],
  sky_day: ["Day", "Tag", "Dag", "白天"],
  sky_dusk: ["Dusk", "Dämmerung", "Skumring", "黄昏"],
  sky_night: ["Night", "Nacht", "Natt", "夜间"],

  // Time
  time: ["Time", "Zeit", "Tid", "时间"],
  rate: ["Rate", "Zeitfaktor", "Tidsfaktor", "倍速"],
  pause: ["Pause", "Pause", "Pause", "暂停"],
  go_on: ["Go on", "Weiter", "Fortsett", "继续"],
  paused: ["Paused", "Angehalten", "Pauset", "已暂停"],
  step: ["One step", "Ein Schritt", "Ett steg", "单步"],
  really: ["runs at {rate}×", "läuft mit {rate}×", "går med {rate}×", "实际 {rate}×"],

  // Instructor
  ships: ["Ships", "Schiffe", "Skip", "船舶"],
  conn: ["Conn", "Übernehmen", "Overta", "接管"],
  fail_rudder: ["Rudder stuck", "Ruder klemmt", "Ror sitter fast", "卡舵"],
  fail_blackout: ["Blackout", "Blackout", "Blackout", "失电"],
  armed: ["Failures to come", "Ausfälle, die kommen", "Feil som kommer", "预设故障"],
  failure: ["Failure", "Ausfall", "Feil", "故障"],
  condition: ["When", "Wann", "Når", "条件"],
  arm_value: ["Time or distance", "Zeit oder Abstand", "Tid eller avstand", "时刻或距离"],
  arm_at: ["at the time [min:s]", "zur Zeit [min:s]", "ved tiden [min:s]", "在时刻 [分:秒]"],
  arm_near: ["within [NM] of {ship}", "näher als [sm] an {ship}", "nærmere enn [nm] fra {ship}", "距 {ship} 小于 [海里]"],
  arm: ["Arm", "Vormerken", "Legg inn", "预设"],
  disarm: ["Disarm", "Streichen", "Fjern", "取消"],
  none_armed: ["No failure is armed.", "Kein Ausfall ist vorgemerkt.", "Ingen feil er lagt inn.", "没有预设故障。"],
  armed_at: ["{ship}: {what} at {time}", "{ship}: {what} bei {time}", "{ship}: {what} ved {time}", "{ship}：{what}，时刻 {time}"],
  armed_near: ["{ship}: {what} within {range} of {of}", "{ship}: {what} näher als {range} an {of}", "{ship}: {what} nærmere enn {range} fra {of}", "{ship}：{what}，距 {of} 小于 {range}"],
  no_time: [
    "“{text}” is no time: give minutes and seconds such as 12:30.",
    "„{text}“ ist keine Zeit: Minuten und Sekunden eingeben, etwa 12:30.",
    "«{text}» er ingen tid: skriv minutter og sekunder, for eksempel 12:30.",
    "“{text}”不是时刻：请输入分和秒，如 12:30。",
  ],
  no_range: [
    "“{text}” is no distance: give one such as 0.5, in nautical miles, or 900 m.",
    "„{text}“ ist kein Abstand: etwa 0,5 in Seemeilen oder 900 m eingeben.",
    "«{text}» er ingen avstand: skriv for eksempel 0,5 i nautiske mil, eller 900 m.",
    "“{text}”不是距离：请输入如 0.5（海里）或 900 m。",
  ],
  environment: ["Wind and current", "Wind und Strom", "Vind og strøm", "风与流"],
  speed_unit: ["Unit of speeds", "Einheit der Geschwindigkeiten", "Enhet for fart", "速度单位"],
  no_speed: [
    "“{text}” is no speed: give a number such as 12, 12 kn or 6 m/s.",
    "„{text}“ ist keine Geschwindigkeit: etwa 12, 12 kn oder 6 m/s eingeben.",
    "«{text}» er ingen fart: skriv for eksempel 12, 12 kn eller 6 m/s.",
    "“{text}”不是速度：请输入如 12、12 kn 或 6 m/s。",
  ],
  too_fast: [
    "“{text}” is beyond the limit: give at most {most}.",
    "„{text}“ liegt über der Grenze: höchstens {most} eingeben.",
    "«{text}» er over grensen: skriv høyst {most}.",
    "“{text}”超出限值：最大 {most}。",
  ],
  no_direction: [
    "“{text}” is no direction: give 0 to 360 degrees.",
    "„{text}“ ist keine Richtung: 0 bis 360 Grad eingeben.",
    "«{text}» er ingen retning: skriv 0 til 360 grader.",
    "“{text}”不是方向：请输入 0 至 360 度。",
  ],
  wind_speed: ["Wind [{unit}]", "Wind [{unit}]", "Vind [{unit}]", "风速 [{unit}]"],
  wind_from: ["from [°]", "aus [°]", "fra [°]", "来向 [°]"],
  current_speed: ["Current [{unit}]", "Strom [{unit}]", "Strøm [{unit}]", "流速 [{unit}]"],
  current_towards: ["towards [°]", "nach [°]", "mot [°]", "去向 [°]"],
  set: ["Set", "Setzen", "Sett", "设定"],
  marks: ["Marks", "Marken", "Merker", "标记"],
  mark_name: ["Name of the mark", "Name der Marke", "Navn på merket", "标记名称"],
  mark_note: ["Note on it", "Notiz dazu", "Notat til det", "备注"],
  set_mark: ["Set mark", "Marke setzen", "Sett merke", "设置标记"],
  go_back: ["Go back to {name}, {time}", "Zurück zu {name}, {time}", "Gå tilbake til {name}, {time}", "返回 {name}，{time}"],
  no_marks: ["No mark has been set.", "Es ist keine Marke gesetzt.", "Ingen merker er satt.", "尚未设置标记。"],
  end_run: ["End the run", "Lauf beenden", "Avslutt kjøringen", "结束运行"],
  end_sure: ["End for everybody", "Für alle beenden", "Avslutt for alle", "为所有人结束"],
  log_book: ["Log", "Logbuch", "Loggbok", "航海日志"],
  follow: ["Centre on {ship}", "Auf {ship} zentrieren", "Sentrer på {ship}", "以 {ship} 为中心"],
  log_collision_begins: ["Contact: {ship_a} and {ship_b}", "Kontakt: {ship_a} und {ship_b}", "Kontakt: {ship_a} og {ship_b}", "接触：{ship_a} 与 {ship_b}"],
  log_collision_ends: [
    "{ship_a} and {ship_b} are clear of each other, {energy} MJ",
    "{ship_a} und {ship_b} sind frei voneinander, {energy} MJ",
    "{ship_a} og {ship_b} er klar av hverandre, {energy} MJ",
    "{ship_a} 与 {ship_b} 脱离接触，{energy} MJ",
  ],
  log_command: ["{client} is in command of {ship}", "{client} hat das Kommando von {ship}", "{client} har kommandoen på {ship}", "{client} 指挥 {ship}"],
  log_command_none: ["Nobody is in command of {ship}", "Niemand hat das Kommando von {ship}", "Ingen har kommandoen på {ship}", "{ship} 无人指挥"],
  log_failure_on: ["{ship}: {what}", "{ship}: {what}", "{ship}: {what}", "{ship}：{what}"],
  log_failure_off: ["{ship}: {what} has ended", "{ship}: {what} ist behoben", "{ship}: {what} er over", "{ship}：{what} 已恢复"],
  log_mark: ["Mark {name}", "Marke {name}", "Merke {name}", "标记 {name}"],
  log_back: ["Back at {name}", "Zurück bei {name}", "Tilbake ved {name}", "返回 {name}"],
  log_environment: [
    "Wind {wind} from {from}°, current {current}",
    "Wind {wind} aus {from}°, Strom {current}",
    "Vind {wind} fra {from}°, strøm {current}",
    "风 {wind}，来自 {from}°，流 {current}",
  ],
  log_horn: ["{ship} sounds the horn", "{ship} gibt Schallsignal", "{ship} gir lydsignal", "{ship} 鸣笛"],
  log_rate: ["Rate {rate}\u00d7", "Zeitfaktor {rate}\u00d7", "Tidsfaktor {rate}\u00d7", "倍速 {rate}\u00d7"],
  log_pause: ["Paused", "Angehalten", "Pauset", "已暂停"],
  log_go_on: ["Goes on", "Weiter", "Fortsetter", "继续"],
  centre_all: ["All ships", "Alle Schiffe", "Alle skip", "所有船舶"],

  // Keys
  key_rudder: ["rudder 5° to port, to starboard; with Shift 1°", "Ruder 5° Backbord, Steuerbord; mit Umschalt 1°", "ror 5° babord, styrbord; med Shift 1°", "左、右舵 5°；按住 Shift 为 1°"],
  key_hard: ["hard over to port, to starboard", "hart Backbord, hart Steuerbord", "hardt babord, hardt styrbord", "左满舵、右满舵"],
  key_midships: ["midships", "mittschiffs", "midtskips", "正舵"],
  key_telegraph: ["telegraph up, down", "Telegraf vor, zurück", "telegraf opp, ned", "车钟加、减"],
  key_stop: ["stop engine", "Maschine stopp", "stopp maskin", "停车"],
  key_autopilot: ["autopilot on this heading, off", "Autopilot auf diesem Kurs ein, aus", "autopilot på denne kursen, av", "以当前航向开、关自动舵"],
  key_heading: ["heading to steer 1° less, more; with Shift 10°", "Sollkurs 1° weniger, mehr; mit Umschalt 10°", "kurs å styre 1° mindre, mer; med Shift 10°", "设定航向减、加 1°；按住 Shift 为 10°"],
  key_horn: ["horn, as long as it is held", "Typhon, solange gedrückt", "tåkelur så lenge den holdes", "按住鸣笛"],
  key_acknowledge: ["acknowledge alarms", "Alarme quittieren", "kvitter alarmer", "确认报警"],
  key_camera: ["next camera; 1 to 6 choose one", "nächste Kamera; 1 bis 6 wählen", "neste kamera; 1 til 6 velger", "下一视角；1 至 6 选择"],
  key_look: ["look 15° to port, to starboard", "15° nach Backbord, Steuerbord blicken", "se 15° til babord, styrbord", "向左、向右转视线 15°"],
  key_binoculars: ["binoculars", "Fernglas", "kikkert", "望远镜"],
  key_chart: ["chart in place of the picture", "Karte statt Bild", "kart i stedet for bilde", "海图与画面切换"],
  key_orientation: ["north up, head up", "Nord oben, voraus oben", "nord opp, forut opp", "北向上、艏向上"],
  key_range: ["larger, smaller range", "größerer, kleinerer Bereich", "større, mindre område", "扩大、缩小量程"],
  key_plain: ["plain sea", "einfache See", "enkel sjø", "简化海面"],
  key_sky: ["next time of day", "nächste Tageszeit", "neste tid på døgnet", "下一时段"],
  key_full: ["full screen", "Vollbild", "fullskjerm", "全屏"],
  key_pause: ["pause, go on", "Pause, weiter", "pause, fortsett", "暂停、继续"],
  key_theme: ["light, dark", "hell, dunkel", "lys, mørk", "浅色、深色"],
  key_help: ["this card", "diese Karte", "dette kortet", "本卡片"],
  looking: [
    "Drag the picture to look around; turn the mouse wheel to zoom.",
    "Ziehen im Bild dreht den Blick; das Mausrad zoomt.",
    "Dra i bildet for å se deg rundt; musehjulet zoomer.",
    "拖动画面环视；滚动鼠标滚轮缩放。",
  ],
};

const KEY = "shipcollision-language";
const listeners = [];
let index = ORDER.indexOf(firstLanguage());

function firstLanguage() {
  let wanted = [];
  try {
    wanted = [localStorage.getItem(KEY)];
  } catch {
    // no storage
  }
  const browsers = (globalThis.navigator?.languages ?? []).map((name) => name.toLowerCase().split("-")[0]);
  const known = { no: "nb", nn: "nb" };
  return [...wanted, ...browsers].map((name) => known[name] ?? name).find((name) => ORDER.includes(name)) ?? "en";
}

export const language = () => ORDER[index];

/** Chooses a language, for this browser's next pages as well unless `isKept` is false. */
export function setLanguage(name, isKept = true) {
  index = Math.max(0, ORDER.indexOf(name));
  document.documentElement.lang = name;
  try {
    if (isKept) localStorage.setItem(KEY, name);
  } catch {
    // not kept, then
  }
  for (const listener of listeners) listener();
}

/** Adds the texts of a page: {key: [English, German, Norwegian, Chinese]}. */
export const addTexts = (table) => Object.assign(TEXTS, table);

/** Calls `listener` now and after every change of the language. */
export function onLanguage(listener) {
  listeners.push(listener);
  listener();
}

/** The text of a key in the present language, with its values in their places. */
export function say(key, values = {}) {
  return TEXTS[key][index].replace(/\{(\w+)\}/g, (_, name) => values[name]);
}

/** Gives an element texts that follow the language: {text: key} or {"aria-label": key, title: key}. Returns it. */
export function inWords(node, keys, values) {
  onLanguage(() => {
    for (const [attribute, key] of Object.entries(keys)) {
      if (attribute === "text") node.textContent = say(key, values);
      else node.setAttribute(attribute, say(key, values));
    }
  });
  return node;
}

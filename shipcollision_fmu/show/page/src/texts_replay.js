// The texts of the replay page that the live pages do not have: English, German, Norwegian, Chinese, as in texts.js.
import { addTexts } from "./texts.js";

export const REPLAY = {
  slow_motion: ["Slow motion around impacts", "Zeitlupe um Zusammenstöße", "Sakte film rundt sammenstøt", "碰撞慢动作"],
  rate_of_play: ["Seconds of the run per second", "Sekunden des Laufs je Sekunde", "Sekunder av kjøringen per sekund", "每秒播放的模拟秒数"],
  // Page
  replay_picture: ["The ships, at the time of the slider", "Die Schiffe zur Zeit des Schiebers", "Skipene ved tiden på glideren", "滑块所示时刻的船舶"],
  native_run: ["Native run: its FMUs ran without Python.", "Nativer Lauf: seine FMUs liefen ohne Python.", "Nativ kjøring: FMU-ene kjørte uten Python.", "原生运行：其 FMU 不使用 Python。"],
  no_webgl: [
    "The picture cannot be shown: {message}. It needs WebGL 2, which this browser does not offer or has switched off.",
    "Das Bild kann nicht gezeigt werden: {message}. Es braucht WebGL 2, das dieser Browser nicht bietet oder abgeschaltet hat.",
    "Bildet kan ikke vises: {message}. Det trenger WebGL 2, som denne nettleseren ikke har eller har slått av.",
    "无法显示画面：{message}。需要 WebGL 2，此浏览器不支持或已关闭。",
  ],
  panel: ["Curves and collisions", "Kurven und Kollisionen", "Kurver og kollisjoner", "曲线与碰撞"],

  // Bar
  play: ["Play", "Abspielen", "Spill av", "播放"],
  previous_collision: ["Previous collision", "Vorige Kollision", "Forrige kollisjon", "上一次碰撞"],
  next_collision: ["Next collision", "Nächste Kollision", "Neste kollisjon", "下一次碰撞"],
  speed_of_play: ["Speed of play", "Abspielgeschwindigkeit", "Avspillingsfart", "播放速度"],
  camera_impact: ["Impact", "Aufprall", "Sammenstøt", "碰撞点"],
  camera_free: ["Free", "Frei", "Fri", "自由"],
  follow_ship: ["Follow {ship}", "{ship} folgen", "Følg {ship}", "跟随 {ship}"],
  no_full_screen: ["This browser offers no full screen.", "Dieser Browser bietet kein Vollbild.", "Denne nettleseren har ikke fullskjerm.", "此浏览器不支持全屏。"],
  record: ["Record a video", "Video aufnehmen", "Ta opp video", "录制视频"],
  stop_recording: ["Stop recording", "Aufnahme beenden", "Stopp opptaket", "停止录制"],
  recording: [
    "Recording the picture until you stop, or the run ends.",
    "Das Bild wird aufgenommen, bis Sie anhalten oder der Lauf endet.",
    "Bildet tas opp til du stopper, eller kjøringen er slutt.",
    "正在录制画面，直到停止或运行结束。",
  ],
  recorded: ["Saved {name}, {size} MB.", "{name} gespeichert, {size} MB.", "Lagret {name}, {size} MB.", "已保存 {name}，{size} MB。"],
  no_video: [
    "This browser cannot record WebM video. Chromium and Firefox can.",
    "Dieser Browser kann kein WebM-Video aufnehmen. Chromium und Firefox können es.",
    "Denne nettleseren kan ikke ta opp WebM-video. Chromium og Firefox kan.",
    "此浏览器无法录制 WebM 视频。Chromium 和 Firefox 可以。",
  ],

  // Two runs
  comparison: ["Differences", "Unterschiede", "Forskjeller", "差异"],
  difference: ["Difference", "Differenz", "Forskjell", "差值"],
  least_clearance: ["Least clearance", "Kleinster Abstand", "Minste klaring", "最小间距"],
  first_run: ["{run}: ships, solid lines", "{run}: Schiffe, durchgezogene Linien", "{run}: skip, heltrukne linjer", "{run}：船舶，实线"],
  second_run: ["{run}: outlines, dashed lines", "{run}: Umrisse, gestrichelte Linien", "{run}: omriss, stiplede linjer", "{run}：轮廓，虚线"],

  // Collisions
  collisions: ["Collisions", "Kollisionen", "Kollisjoner", "碰撞"],
  between: ["Between", "Zwischen", "Mellom", "船舶双方"],
  closing: ["Closing", "Annäherung", "Tilnærming", "接近速度"],
  angle: ["Angle", "Winkel", "Vinkel", "角度"],
  impulse: ["Impulse", "Impuls", "Impuls", "冲量"],
  energy: ["Energy", "Energie", "Energi", "能量"],
  no_contact: [
    "No contact. The hulls came within {distance} m of each other.",
    "Kein Kontakt. Die Rümpfe kamen sich auf {distance} m nahe.",
    "Ingen kontakt. Skrogene kom innen {distance} m av hverandre.",
    "无接触。船体最近距离为 {distance} m。",
  ],

  // Curves
  curves: ["Curves", "Kurven", "Kurver", "曲线"],
  curve_of: ["{title} over time, in {unit}", "{title} über der Zeit, in {unit}", "{title} over tid, i {unit}", "{title}随时间变化，单位 {unit}"],
  speed: ["Speed", "Geschwindigkeit", "Fart", "航速"],
  surge: ["Surge", "Längsgeschwindigkeit", "Jag", "纵荡速度"],
  yaw_rate: ["Yaw rate", "Gierrate", "Girhastighet", "艏摇角速度"],
  roll: ["Roll", "Rollwinkel", "Rull", "横摇"],
  heading: ["Heading", "Steuerkurs", "Heading", "艏向"],
  clearance: ["Clearance", "Abstand", "Klaring", "间距"],
  dissipated: ["dissipated", "dissipiert", "dissipert", "耗散"],
  normal: ["normal", "normal", "normal", "法向"],
  tangential: ["tangential", "tangential", "tangentiell", "切向"],
  steady: ["Left out, as it does not change: {what}", "Weggelassen, da unverändert: {what}", "Utelatt, endrer seg ikke: {what}", "未变化，故省略：{what}"],

  // Track plot
  track_plot: ["Track plot", "Bahn", "Sporplott", "航迹图"],
  track_plot_label: [
    "Tracks seen from above, north up, in m; outlines are the ships at the time of the slider",
    "Bahnen von oben, Norden oben, in m; Umrisse sind die Schiffe zur Zeit des Schiebers",
    "Spor sett ovenfra, nord opp, i m; omriss er skipene ved tiden på glideren",
    "俯视航迹，北向上，单位 m；轮廓为滑块所示时刻的船舶",
  ],
  north_short: ["N", "N", "N", "北"],

  // Keys
  key_space: ["space", "Leertaste", "mellomrom", "空格"],
  key_play: ["play, pause", "abspielen, anhalten", "spill av, pause", "播放、暂停"],
  key_seconds: ["one second back, on; with Shift a tenth", "eine Sekunde zurück, vor; mit Umschalt ein Zehntel", "et sekund tilbake, fram; med Shift et tidels sekund", "后退、前进一秒；按住 Shift 为十分之一秒"],
  key_ends: ["start, end", "Anfang, Ende", "start, slutt", "开始、结束"],
  key_collisions: ["next, previous collision", "nächste, vorige Kollision", "neste, forrige kollisjon", "下一次、上一次碰撞"],
  key_next_camera: ["next camera", "nächste Kamera", "neste kamera", "下一视角"],
  key_record: ["record a video, stop", "Video aufnehmen, beenden", "ta opp video, stopp", "录制视频、停止"],
  key_panel: ["curves and collisions", "Kurven und Kollisionen", "kurver og kollisjoner", "曲线与碰撞"],
  mouse_and_curves: [
    "Drag to turn the camera, wheel to zoom, right button to move. Click a curve to go to its time; drag across it to zoom, double-click to see all again.",
    "Ziehen dreht die Kamera, das Mausrad zoomt, die rechte Taste verschiebt. Ein Klick auf eine Kurve führt zu ihrer Zeit; Ziehen darüber vergrößert, ein Doppelklick zeigt wieder alles.",
    "Dra for å snu kameraet, musehjulet zoomer, høyre knapp flytter. Klikk på en kurve for å gå til tiden; dra over den for å zoome, dobbeltklikk for å se alt igjen.",
    "拖动旋转视角，滚轮缩放，右键平移。点击曲线跳到该时刻；在曲线上拖动可放大，双击恢复全部。",
  ],
};

addTexts(REPLAY);

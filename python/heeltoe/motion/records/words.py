"""Words of headers in eleven languages: English, German, French, Spanish, Italian, Portuguese, Turkish, Greek, Russian,
Japanese and Chinese; each as :func:`folded` leaves it."""

from __future__ import annotations

import re
import unicodedata

from heeltoe.base.pattern import pattern

_LETTERS = str.maketrans({"ı": "i", "ς": "σ", "−": "-", "–": "-", "·": " ", "μ": "u", "µ": "u", "，": ",", "：": ":"})


def folded(text: str) -> str:
    """Return a text in small letters without accents, with plain digits for raised and wide ones."""
    plain = unicodedata.normalize("NFKD", text.replace("İ", "i").translate(_LETTERS))
    bare = "".join(letter for letter in plain if not unicodedata.combining(letter))
    return bare.casefold().translate(_LETTERS)


def _one_of(*texts: str) -> str:
    """A pattern of any of some words; a blank in one is any number of blanks, dashes or underscores.

    A letter of the Latin, Greek or Cyrillic script on either side makes another word; Chinese has no blanks.
    """
    words = sorted((folded(word) for text in texts for word in text.split("|")), key=len, reverse=True)
    pattern = "|".join(re.escape(word).replace("\\ ", r"[\s_.-]*") for word in words)
    return rf"(?<![a-z\u0370-\u03ff\u0400-\u04ff])(?:{pattern})(?![a-z\u0370-\u03ff\u0400-\u04ff])"


TIME = _one_of(
    "time|times|t|sec|secs|second|seconds|zeit|temps|tiempo|tempo|zaman|sure|χρόνος|χρονος|время|時間|時刻|时间|時間軸"
)
#: A time beyond doubt, where t may be a period.
TIME_IN_WORDS = _one_of("time|times|Zeit|temps|tiempo|tempo|zaman|χρόνος|время|時間|時刻|时间|時間軸")
STEP = _one_of(
    "time step|tstep|t step|step size|time increment|time interval|sampling interval|sample interval|sampling period"
    "|sample period|sampling step|sample spacing|time spacing|delta t|deltat|δt|dt|δ t|step of time|sampling time",
    "delta|every|alle|takt|chaque|cada|a cada|ogni|her|ανά|через|毎|每",
    "Zeitschritt|Zeitschrittweite|Zeitintervall|Abtastintervall|Abtastzeit|Schrittweite|Zeitinkrement",
    "pas de temps|pas d'échantillonnage|pas d'echantillonnage|intervalle d'échantillonnage|intervalle de temps|pas",
    "intervalo de muestreo|intervalo de tiempo|paso de tiempo|paso temporal|incremento de tiempo|paso|intervalo",
    "passo temporale|passo di campionamento|intervallo di campionamento|intervallo di tempo|passo|intervallo",
    "passo de tempo|intervalo de amostragem|passo temporal|intervalo de tempo|incremento de tempo",
    "zaman adımı|zaman aralığı|örnekleme aralığı|örnekleme adımı|zaman artımı",
    "χρονικό βήμα|βήμα χρόνου|διάστημα δειγματοληψίας|βήμα",
    "шаг по времени|шаг времени|интервал дискретизации|шаг дискретизации|временной шаг|шаг",
    "時間刻み|時間間隔|サンプリング間隔|サンプリング周期|刻み時間",
    "时间间隔|时间步长|采样间隔|采样周期|步长|时间步",
)
RATE = _one_of(
    "sampling rate|sample rate|samplerate|sampling frequency|sampling freq|samples per second|sps|sampling|fs",
    "Abtastrate|Abtastfrequenz|Samplerate",
    "fréquence d'échantillonnage|taux d'échantillonnage|frequence d'echantillonnage",
    "frecuencia de muestreo|tasa de muestreo|velocidad de muestreo|vel. de muestreo",
    "frequenza di campionamento|tasso di campionamento",
    "frequência de amostragem|taxa de amostragem",
    "örnekleme frekansı|örnekleme hızı|örnekleme oranı",
    "συχνότητα δειγματοληψίας|ρυθμός δειγματοληψίας",
    "частота дискретизации|частота опроса",
    "サンプリング周波数|サンプリングレート|標本化周波数",
    "采样率|采样频率",
)
COUNT = _one_of(
    "npts|npt|nopts|number of points|number of data points|number of samples|number of values|number of data"
    "|number of steps|no. of points|no. of data|no. of data points|no. of samples|no. of values|no. of steps"
    "|num. of points|points|samples|data points|num points|num samples|length in samples|data count|count",
    "Anzahl der Werte|Anzahl Werte|Anzahl der Punkte|Anzahl Punkte|Anzahl der Datenpunkte|Anzahl Datenpunkte"
    "|Anzahl der Messwerte|Anzahl Messwerte|Anzahl der Abtastwerte|Anzahl Abtastwerte|Anzahl|Punkte|Werte",
    "nombre de points|nombre de valeurs|nombre d'échantillons|nombre de données|nombre de pas|nb de points",
    "número de datos|número de puntos|número de muestras|número de valores|num. total de muestras|no. de datos"
    "|no. de puntos|total de datos|n° de puntos",
    "numero di punti|numero di campioni|numero di dati|numero di valori|n. punti|numero punti|numero campioni",
    "número de pontos|número de amostras|número de dados|número de valores|n° de pontos",
    "veri sayısı|nokta sayısı|örnek sayısı|data sayısı|toplam veri",
    "αριθμός σημείων|αριθμός τιμών|αριθμός δεδομένων|αριθμός δειγμάτων|πλήθος τιμών|πλήθος σημείων|πλήθος",
    "число точек|число отсчетов|число отсчётов|число значений|количество точек|количество отсчетов"
    "|количество отсчётов|количество значений|кол-во точек",
    "データ数|データ点数|サンプル数|点数|個数",
    "数据点数|数据个数|采样点数|样点数|点数|数据量",
)
DURATION = _one_of(
    "duration|record length|length of record|recordlength|total time|total duration|record duration|recording time",
    "Dauer|Gesamtdauer|Aufzeichnungsdauer|Aufnahmedauer",
    "durée|duree totale|durée totale",
    "duración|duración total|longitud del registro",
    "durata|durata totale",
    "duração|duração total",
    "süre|kayıt süresi|toplam süre|kayıt uzunluğu",
    "διάρκεια|συνολική διάρκεια",
    "длительность|продолжительность|длина записи",
    "継続時間|記録時間|記録長",
    "持续时间|持时|记录长度|总时长|时长",
)
PEAK = _one_of(
    "pga|peak ground acceleration|peak acceleration|peak|peak value|maximum acceleration|max acceleration|max. acc"
    "|max. acc.|max acc|maximum|max|max. acceleration|max accel|peak acc|peak accel|pk|amax|a max|pk acc",
    "Spitzenwert|Maximalwert|Spitzenbeschleunigung|maximale Beschleunigung|Maximum|Bodenbeschleunigung max",
    "pic|accélération maximale|valeur maximale|accélération max|pga max|accélération de pointe",
    "pico|aceleración máxima|acel. max|acel. máx.|valor máximo|máximo|aceleración pico",
    "picco|accelerazione massima|valore massimo|accelerazione di picco|massimo",
    "aceleração máxima|aceleração de pico|máximo",
    "en büyük ivme|maksimum ivme|maks. ivme|maks|pik|pik ivme|tepe ivmesi|en yüksek ivme|maksimum",
    "μέγιστη επιτάχυνση|μέγιστη τιμή|μέγιστη|μέγιστο|μέγιστη εδαφική επιτάχυνση",
    "максимум|максимальное ускорение|макс|макс. ускорение|пик|пиковое ускорение|пиковое значение",
    "最大加速度|最大値|最大",
    "最大值|峰值|峰值加速度|加速度峰值|最大加速度",
)
ACCELERATION = _one_of(
    "acc|accel|acceleration|accelerations|accn|a|ag|ax|ay|az|accelerogram|Beschleunigung|Bodenbeschleunigung"
    "|accélération|aceleración|acel|accelerazione|aceleração|ivme|ivmesi|επιτάχυνση|ускорение|加速度|accl"
)
VELOCITY = (
    r"(?<!加)速度|(?<![a-z\u0370-\u03ff\u0400-\u04ff])"
    r"(?:vel|geschwindigkeit|vitesse|hiz(?![a-z])|pgv|ταχυτητα|скорост|v(?:x|y|z)?(?=\s*[\[(]))"
)
DISPLACEMENT = (
    r"変位|位移|(?<![a-z\u0370-\u03ff\u0400-\u04ff])"
    r"(?:disp|verschiebung|deplacement|desplazamiento|spostament|deslocamento|yer ?degistirme|deplasman|pgd|μετατοπιση"
    r"|μετακινηση|перемещени|смещени|d(?:x|y|z)?(?=\s*[\[(]))"
)
UNIT = _one_of(
    "unit|units|Einheit|Einheiten|unité|unités|unidad|unidades|unità|unidade|birim|birimi|μονάδα|μονάδες|единица"
    "|единицы|ед. изм.|ед|単位|单位"
)
#: Names of the first column of a table that is no record, or of one of its columns.
OTHER_AXES = _one_of(
    "period|periods|periode|période|periodo|periyot|periyod|περίοδος|период|周期|freq|frequency|frequenz|fréquence"
    "|frecuencia|frequenza|frequência|frekans|συχνότητα|частота|周波数|振動数|频率|omega"
    "|mag|magnitude|magnitud|magnitudine|büyüklük|μέγεθος|магнитуда|マグニチュード|震级|mw|ml"
    "|dist|distance|distanz|entfernung|distancia|distanza|distância|uzaklık|mesafe|απόσταση|расстояние|距離|距离|rjb|rrup"
    "|repi|rhypo|return period|annual rate|annual|poe|probability|exceedance|afe|mafe|hazard|iml|rsn|vs30"
    "|t n|lon|longitude|lat|latitude"
)
SPECTRAL = _one_of(
    "psa|psv|prv|sae|rsa|rotd50|rotd100|sa(t)|se(t)|sd(t)|sv(t)|spectral|spectral acceleration|spectrum|spectra"
    "|spektral|spektrum|Spektralbeschleunigung|spectre|spectrale|espectro|espectral|spettro|spettrale|φάσμα|φασματική"
    "|спектр|спектральное|スペクトル|反応|谱|反应谱|谱加速度|応答"
)
#: Which samples they are.
INDEX = _one_of(
    "no|no.|nr|nr.|n|n°|index|i|k|sample|point|pt|#|row|id|Nummer|numéro|número|numero|sıra|α/α|№|номер|番号|序号|num"
)
WAY = pattern(
    folded(
        r"(?:[nsewo]|[ns][ewo]|[ns]-?[ns]|[ew]-?[ew]|eo|n-s|e-w|u-?d|[ns]\s*\d{1,3}\s*[ew]?|ns|ew|ud|z|up|down|dwn|dn"
        r"|ver|vert|vertical\w*|vertikal\w*|verticale|hor\w*|h[12]|long\w*|tran\w*|radial|[xyzlthvr][123]?"
        r"|[behl][hnl][nezrt123]"
        r"|\d{1,3}(?:\s*deg\w*|°)?|ch(?:an(?:nel)?)?[ _-]?\d+|canal-?\s?\d+|kanal\s?\d+|comp\w*[ _-]?\w{0,3}"
        r"|a[_-]?[xyznewv]"
        r"|acc(?:el)?[ _-]?[xyznewudhv]{0,2}\d?|north\w*|south\w*|east\w*|west\w*|nord|sud|süd|ost|est|ouest|norte"
        r"|sur|este"
        r"|oeste|kuzey\w*|güney\w*|doğu\w*|batı\w*|düşey|yatay|север\w*|восток|юг|запад|верт\w*|南北|東西|上下|东西|竖向|垂直)"
    )
)
